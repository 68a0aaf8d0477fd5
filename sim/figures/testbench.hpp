// SPDX-License-Identifier: Apache-2.0
// Testbenches of tb/ in GHDL, whose reports or traces a figure shows.
#pragma once

#include <string>
#include <vector>

#include "sim/figures/figure.hpp"

namespace halfway::figures {

/// Analyses the sources and runs `top` with these options: what it prints. Throws Failure, if the testbench
/// fails too.
std::string run_testbench(const Context& context, const std::string& top, std::vector<VhdlSource> sources,
                          const std::vector<std::string>& testbench_files,
                          const std::vector<std::string>& options);

}  // namespace halfway::figures

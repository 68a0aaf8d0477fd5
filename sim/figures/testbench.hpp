// SPDX-License-Identifier: Apache-2.0
// Run testbenches of tb/ in GHDL for figures of their reports or traces.
#pragma once

#include <string>
#include <vector>

#include "sim/figures/figure.hpp"

namespace halfway::figures {

/// Analyse the sources, run `top` with these options and return its output. Throws Failure, also if the
/// testbench fails.
std::string run_testbench(const Context& context, const std::string& top, std::vector<VhdlSource> sources,
                          const std::vector<std::string>& testbench_files,
                          const std::vector<std::string>& options);

}  // namespace halfway::figures

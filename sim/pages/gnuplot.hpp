// SPDX-License-Identifier: Apache-2.0
// Runs gnuplot.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/result.hpp"

namespace halfway {

/// The SVG that a gnuplot script draws; the script sets the terminal, not the output. Keeps the script as
/// `name`.gnuplot in `folder`. Any output of gnuplot's, warnings included, is an error.
Result<std::string> run_gnuplot(std::string_view script, const std::filesystem::path& folder,
                                const std::string& name);

}  // namespace halfway

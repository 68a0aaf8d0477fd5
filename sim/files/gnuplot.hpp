// SPDX-License-Identifier: Apache-2.0
// Runs gnuplot; the common style of all plots.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

namespace halfway {

/// The colours of all plots: of medium lightness, for white and dark backgrounds.
inline constexpr std::array c_plot_colours = {"#767676", "#b8860b", "#0072b2", "#2a9df4",
                                              "#009e73", "#d55e00", "#cc5fa0", "#8a63d2",
                                              "#7a9a01", "#c0392b", "#17a2b8", "#a0522d"};

/// The start of every script: an SVG of this size in the common style.
std::string plot_style(double width, double height);

/// A double-quoted string of a gnuplot script.
std::string gnuplot_text(std::string_view text);

/// The SVG that a gnuplot script draws; the script sets the terminal, not the output. Keeps the script as
/// `name`.gnuplot in `folder`. Any output of gnuplot's, warnings included, throws Failure.
std::string run_gnuplot(std::string_view script, const std::filesystem::path& folder,
                        const std::string& name);

}  // namespace halfway

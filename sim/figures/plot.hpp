// SPDX-License-Identifier: Apache-2.0
// Plots as SVG, by gnuplot.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "frame/frame_size.hpp"
#include "sim/figures/figure.hpp"

namespace halfway::figures {

struct Plot {
  FrameSize size{760, 340};
  std::string title;   ///< what the picture shows: the SVG's title, and its text in the page
  std::string words;   ///< what it says, for those who do not see it; may be empty
  std::string script;  ///< after terminal and output are set
};

/// "$name << EOD", rows of numbers, "EOD".
std::string data_block(const std::string& name, std::span<const std::vector<double>> rows);

/// Writes NAME.svg into the context's folder, its script beside it, and notes it in the drawing. Throws
/// Failure where there is no gnuplot.
void draw_plot(const Context& context, const std::string& name, const Plot& plot, Drawing& drawing);

/// Which gnuplot drew an SVG: two versions do not write the same bytes.
std::string drawn_by(std::string_view svg);

inline constexpr const char* c_install_gnuplot = "apt-get install gnuplot-nox";

}  // namespace halfway::figures

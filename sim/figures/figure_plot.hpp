// SPDX-License-Identifier: Apache-2.0
// Plots as SVG, by gnuplot.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sim/figures/figure.hpp"
#include "sim/files/gnuplot.hpp"

namespace halfway::figures {

struct Plot {
  std::string title;    ///< title of the SVG, and text on the page
  std::string words{};  ///< alternative text; may be empty
  std::string script;   ///< for gnuplot, from plot_style on
};

/// "$name << EOD", rows of numbers, "EOD".
std::string data_block(const std::string& name, std::span<const std::vector<double>> rows);

/// Write NAME.svg and its script into the context's folder, and register the picture in the drawing. Throws
/// Failure without gnuplot.
void draw_plot(const Context& context, const std::string& name, const Plot& plot, Drawing& drawing);

}  // namespace halfway::figures

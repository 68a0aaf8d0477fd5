// SPDX-License-Identifier: Apache-2.0
// SVG plots made by gnuplot: scatter plots whose points are links.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace halfway::report {

struct PlotPoint {
  /// Both axes are logarithmic. Values of 0 have a separate position below or left of the smallest value.
  double x = 0.0, y = 0.0;
  std::size_t series = 0;
  std::size_t number = 0;  ///< the point links to #point-<number>
  std::string name;        ///< for screen readers and tooltips
  bool aside = false;      ///< has class `aside`: not part of the front's comparison
  bool ring = false;       ///< a grey ring is around the mark
  std::string label{};     ///< drawn beside the mark
};
/// A horizontal line across the plot.
struct PlotLevel {
  double y = 0.0;
  std::string name;
};
/// Appearance of a series: colour and gnuplot's point type.
struct PointLook {
  const char* colour;
  int shape;  ///< the SVG contains it as an element called gpPt<shape - 1>
};
struct Plot {
  std::string x_label, y_label;
  std::vector<PlotPoint> points;                 ///< at least one
  std::vector<std::pair<double, double>> front;  ///< points joined by a line; may be empty
  std::vector<PlotLevel> levels;    ///< such as those of a reference method, which has no x value
  std::vector<std::string> legend;  ///< one entry per series; empty: no legend
  std::vector<PointLook> looks{};   ///< of the series; empty: look_of
  std::string ring_legend{};        ///< what a ring means; empty: none is drawn
  bool narrow = false;              ///< for a telephone: the legend is below, otherwise on the right
};

/// Number of the series with this name in the legend. Adds a series that is not in it.
std::size_t series_number(Plot& plot, const std::string& name);

/// The first twelve differ in colour and shape, the first sixty in one of them.
PointLook look_of(std::size_t series);

/// A complete SVG. Each point is an `a` element with a name, in the order of `points`. `scratch` is a folder
/// for gnuplot's files.
std::string draw_plot(const Plot& plot, const std::filesystem::path& scratch);

}  // namespace halfway::report

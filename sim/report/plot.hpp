// SPDX-License-Identifier: Apache-2.0
// Plots by gnuplot, as SVG: points that are links, and timing diagrams.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/result.hpp"

namespace halfway::report {

struct PlotPoint {
  /// Both axes are logarithmic; what is 0 stands apart, below the least or left of it.
  double x = 0.0, y = 0.0;
  std::size_t series = 0;
  std::size_t number = 0;  ///< links to #point-<number>
  std::string name;        ///< what a reader hears
  bool aside = false;      ///< of class `aside`: not what the front is of
};
/// A line across the plot.
struct PlotLevel {
  double y = 0.0;
  std::string name;
};
struct Plot {
  std::string x_label, y_label;
  std::vector<PlotPoint> points;                 ///< one at least
  std::vector<std::pair<double, double>> front;  ///< joined by a line; may be empty
  std::vector<PlotLevel> levels;                 ///< such as a yardstick's, which has no place along x
  std::vector<std::string> legend;               ///< of each series, on the right; empty: none is drawn
};

/// How a series is drawn: colours and gnuplot's types of points, which differ among the first twelve.
struct PointLook {
  const char* colour;
  int shape;  ///< the SVG has it as an element called gpPt<shape - 1>
};
PointLook look_of(std::size_t series);

/// An SVG of its own. Each point is an `a` with a name, in the order of `points`.
/// `scratch` is a folder for gnuplot's files.
Result<std::string> draw_plot(const Plot& plot, const std::filesystem::path& scratch);

/// A signal over some clocks, a value each.
struct Lane {
  std::string name;
  bool wire = false;  ///< of one bit: drawn as a level
  std::vector<std::string> values;
};
/// All lanes of equal length; '' among a bus's values is one that means nothing.
Result<std::string> draw_timing(const std::vector<Lane>& lanes, std::uint64_t first_cycle,
                                const std::filesystem::path& scratch);

}  // namespace halfway::report

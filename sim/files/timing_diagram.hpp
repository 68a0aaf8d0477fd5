// SPDX-License-Identifier: Apache-2.0
// Timing diagrams: signals over time, drawn by gnuplot.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace halfway {

/// Colours of boxes, translucent for light and dark pages: 0xAARRGGBB, where AA is the transparency.
inline constexpr unsigned c_blue_box = 0xd00072b2, c_grey_box = 0xd08a8a8a, c_red_box = 0xd0c0392b;

/// A value of a bus. The text is shown if it fits.
struct TimingBox {
  double from, until;
  std::string text;
  unsigned colour = c_blue_box;
};
/// A value of a wire.
struct TimingLevel {
  double from, until;
  bool high;
};
struct TimingLane {
  std::string name;
  std::vector<TimingBox> boxes{};  ///< later ones are drawn over earlier ones
  std::vector<TimingLevel> levels{};
};
struct TimingDiagram {
  std::vector<TimingLane> lanes;  ///< from top to bottom
  double end = 0.0;               ///< time starts at 0
  double width = 0.0;             ///< pixels, without the names
  std::string axis;
  std::vector<std::pair<double, std::string>> ticks;  ///< place and text
  std::vector<double> lines;                          ///< places of vertical lines
};

/// The script for gnuplot.
std::string timing_script(const TimingDiagram& diagram);

}  // namespace halfway

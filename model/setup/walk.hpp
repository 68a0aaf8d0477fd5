// SPDX-License-Identifier: Apache-2.0
// How the triangle walker of preset exact goes over a triangle: lines, edges and direction, cut to the frame.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "setup/edge.hpp"

namespace halfway {

/// A section of an edge as edge_walker loads it: on a line down, pixel += quotient, and one more where carry.
struct EdgeSection {
  std::int64_t pixel = 0, quotient = 0;
  std::int64_t remainder = 0, divisor = 1;
  std::int64_t error = 0;  ///< after the first step
  bool carry = false;      ///< of the first step
};

/// One init vector's way over the frame. Spans run from the start edge away: forward to larger x, backward to
/// smaller. Every pixel lies in the frame.
struct Walk {
  std::int64_t y = 0;
  std::int64_t upper_lines = 0;  ///< >= 1
  std::int64_t lower_lines = 0;
  bool backward = false;
  EdgeSection start;         ///< its pixel is the span's first
  EdgeSection upper, lower;  ///< stop edge: its pixel is the one after the span's last
};

/// The walks of a triangle: none where no pixel is covered, one where it crosses neither side of the frame,
/// and three at most: beside the frame an edge is held at its side, and a walk takes one section of the start
/// edge with two of the stop edge. Points either way round, in 1/2^unit_bits pixels.
std::vector<Walk> plan_walks(std::array<ScreenPoint, 3> points, int unit_bits, FrameSize frame);

/// One line of a walk, and how the start edge came there: `steps` lines down, of which `carries` with one
/// more pixel.
struct WalkLine {
  Walk walk;  ///< of this line alone
  std::int64_t steps, carries;
  bool empty() const { return walk.start.pixel == walk.upper.pixel; }
};

/// `y` is one of the walk's lines.
WalkLine line_of(const Walk& walk, std::int64_t y);

/// Columns [begin, end) of the frame.
struct Columns {
  std::int64_t begin, end;
  std::int64_t width() const { return end - begin; }
};

/// The same of the part of the triangle that lies in some columns.
std::vector<Walk> plan_walks(std::array<ScreenPoint, 3> points, int unit_bits, Columns columns,
                             std::uint32_t height);

}  // namespace halfway

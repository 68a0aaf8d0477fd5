// SPDX-License-Identifier: Apache-2.0
// The path of preset exact's triangle walker over a triangle: lines, edges and direction, clipped to the
// frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/fixed_vector.hpp"
#include "projection/edge.hpp"

namespace halfway {

/// A section of an edge as loaded by edge_walker: for each line, pixel += quotient, plus one on a carry.
struct EdgeSection {
  std::int64_t pixel = 0, quotient = 0;
  std::int64_t remainder = 0, divisor = 1;
  std::int64_t error = 0;  ///< after the first step
  bool carry = false;      ///< of the first step
};

/// The path of one init vector. Spans run from the start edge: forward to larger x, backward to smaller x.
/// Every pixel lies in the frame.
struct Walk {
  std::int64_t y = 0;
  std::int64_t upper_lines = 0;  ///< >= 1
  std::int64_t lower_lines = 0;
  bool backward = false;
  EdgeSection start;         ///< its pixel is the first of the span
  EdgeSection upper, lower;  ///< stop edge: its pixel is the one after the last of the span
};

/// The walks of a triangle.
inline constexpr std::size_t c_most_walks = 3;
using Walks = FixedVector<Walk, c_most_walks>;

/// The walks of a triangle: none if it covers no pixel, one if it crosses neither side of the frame, at most
/// three. Outside the frame an edge is clamped to the frame's side. A walk contains one section of the start
/// edge and up to two of the stop edge. Points may be in either orientation, in 1/2^unit_bits pixels.
Walks plan_walks(std::array<ScreenPoint, 3> points, int unit_bits, FrameSize frame);

/// One line of a walk, and the steps of the start edge before it: `steps` lines, `carries` of them with an
/// extra pixel.
struct WalkLine {
  Walk walk;  ///< of this line only
  std::int64_t steps, carries;
  bool empty() const { return walk.start.pixel == walk.upper.pixel; }
};

/// `y` must be a line of the walk.
WalkLine line_of(const Walk& walk, std::int64_t y);

/// Columns [begin, end) of the frame.
struct Columns {
  std::int64_t begin, end;
  std::int64_t width() const { return end - begin; }
};

/// The same for the part of the triangle in some columns.
Walks plan_walks(std::array<ScreenPoint, 3> points, int unit_bits, Columns columns, std::uint32_t height);

}  // namespace halfway

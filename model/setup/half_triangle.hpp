// SPDX-License-Identifier: Apache-2.0
// Preset published: a triangle with integer pixel vertices as two halves with a horizontal side. The edges
// are stepped by a real slope.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "projection/edge.hpp"
#include "words/init_vector.hpp"

namespace halfway {

/// A vertex on the screen in whole pixels. Its depth is in depth steps.
struct HalfVertex {
  long double x, y, z;
};

/// Converts a corner of a piece of a triangle, in 1/2^level pixels, to a vertex. A midpoint between pixels is
/// rounded, so a T-junction may show a gap (a published fault).
HalfVertex half_vertex(ScreenPoint corner, int level, double depth_steps);

/// An edge by its ends, the upper one first: indices of the triangle's vertices.
struct HalfEdge {
  std::size_t top, bottom;
};

/// The lines from one vertex to the next lower vertex, both included.
struct HalfTriangle {
  std::int64_t y, lines;
  HalfEdge start, stop;  ///< left and right
  long double x_start, slope_start, x_stop, slope_stop;
};

/// The upper half first. Empty for a triangle of zero area.
std::vector<HalfTriangle> half_triangles(const std::array<HalfVertex, 3>& vertices);

/// First and last pixel of a line.
struct HalfLine {
  std::int64_t first, last;
  bool empty() const { return first > last; }
};

/// The pixels of line y, in the hardware's words.
HalfLine line_of(const HalfTriangle& half, std::int64_t y);

/// Twice the area, (x2-x1)(y3-y1) - (y2-y1)(x3-x1).
long double twice_area(const std::array<HalfVertex, 3>& vertices);

/// The header of preset published: triangle, edges and depth.
void put_header(InitVector& init, std::uint32_t triangle, const HalfTriangle& half,
                const std::array<HalfVertex, 3>& vertices);

}  // namespace halfway

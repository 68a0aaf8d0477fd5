// SPDX-License-Identifier: Apache-2.0
// Preset published: a triangle with whole-pixel vertices as two horizontal-sided halves, whose edges are
// stepped by a real slope.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "setup/init_vector.hpp"

namespace halfway {

/// A vertex on the screen in whole pixels, its depth in steps.
struct HalfVertex {
  long double x, y, z;
};

/// A corner of a piece of a triangle, in 1/2^level pixels, as the vertex of one: a midpoint between pixels is
/// rounded, and a T-junction may open (a published fault).
HalfVertex half_vertex(ScreenPoint corner, int level, double depth_steps);

/// An edge by its ends, upper one first: indices into the triangle's vertices.
struct HalfEdge {
  std::size_t top, bottom;
};

/// The lines from one vertex to the next below it, first and last included.
struct HalfTriangle {
  std::int64_t y, lines;
  HalfEdge start, stop;  ///< left and right
  long double x_start, slope_start, x_stop, slope_stop;
};

/// None for a triangle of no area; the upper half first.
std::vector<HalfTriangle> half_triangles(const std::array<HalfVertex, 3>& vertices);

/// Twice the area, (x2-x1)(y3-y1) - (y2-y1)(x3-x1).
long double twice_area(const std::array<HalfVertex, 3>& vertices);

/// The header of preset published: triangle, edges and depth.
void put_header(InitVector& init, std::uint32_t triangle, const HalfTriangle& half,
                const std::array<HalfVertex, 3>& vertices);

}  // namespace halfway

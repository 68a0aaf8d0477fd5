// SPDX-License-Identifier: Apache-2.0
// The header of preset exact's init vectors: the path of the triangle walker, and the depth along it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "projection/screen_triangle.hpp"
#include "setup/quadratic_fit.hpp"
#include "setup/walk.hpp"
#include "words/init_vector.hpp"

namespace halfway {

inline constexpr double c_depth_steps = double((1 << words::Exact::c_depth_bits) - 1);

/// Converts a depth in [0, 1] to steps. The result is at least one step away from both ends, so that rounding
/// never wraps the 24 bits.
inline double depth_steps(double z) {
  return std::clamp(z * c_depth_steps, 1.0, c_depth_steps - 2.0);
}

/// Depths of a triangle's vertices in the unit of depth_sum.
inline std::array<std::int64_t, 3> fixed_depths(const ScreenTriangle& t) {
  const auto depth = [&](std::size_t i) {
    return fixed(depth_steps(t.vertex[i].z), words::Exact::c_depth_sum_fraction_bits);
  };
  return {depth(0), depth(1), depth(2)};
}

inline std::array<ScreenPoint, 3> screen_points(const ScreenTriangle& t) {
  return {{{t.vertex[0].x, t.vertex[0].y}, {t.vertex[1].x, t.vertex[1].y}, {t.vertex[2].x, t.vertex[2].y}}};
}

/// Writes the header of preset exact from bit `low` of the vector on: triangle, walk and depth.
void put_header(InitVector& init, std::uint32_t triangle, const Walk& walk, const DepthWords& depth,
                int low = 0);

/// The start of the forward differences of a walk.
inline DifferenceStart difference_start(const Walk& walk) {
  return {walk.start.pixel, walk.y, walk.start.quotient, walk.backward};
}

}  // namespace halfway

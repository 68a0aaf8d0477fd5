// SPDX-License-Identifier: Apache-2.0
// The specification of what is drawn from triangles on the screen, in exact integers or long double, without
// any of the tested code. Figures are measured against its values.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "frame/frame_size.hpp"
#include "projection/edge.hpp"
#include "projection/screen_triangle.hpp"
#include "scene/scene.hpp"
#include "setup/walk_header.hpp"
#include "specification/oracle/specification.hpp"

namespace halfway::stability {

using LongVec = oracle::Vector;

using oracle::barycentric, oracle::centre, oracle::covers, oracle::ExactBarycentric, oracle::radiance,
    oracle::Wide;

/// Calls span(y, begin, end) for each line of the frame with covered pixels: `covers` solved for x, edge by
/// edge.
template <class Span>
void for_each_covered_span(std::array<ScreenPoint, 3> p, int unit_bits, FrameSize frame, Span&& span) {
  ExactBarycentric origin = barycentric(p, centre(0, unit_bits), centre(0, unit_bits));
  if (origin.sum == 0) return;
  if (origin.sum < 0) {
    std::swap(p[1], p[2]);
    origin = barycentric(p, centre(0, unit_bits), centre(0, unit_bits));
  }
  const ExactBarycentric right = barycentric(p, centre(1, unit_bits), centre(0, unit_bits)),
                         down = barycentric(p, centre(0, unit_bits), centre(1, unit_bits));
  const auto floor_of = [](Wide n, Wide d) { return n / d - (n % d < 0 ? 1 : 0); };
  const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
  const std::int64_t first = std::max<std::int64_t>((top >> unit_bits) - 1, 0),
                     last = std::min<std::int64_t>((bottom >> unit_bits) + 1, std::int64_t{frame.height} - 1);
  for (std::int64_t y = first; y <= last; ++y) {
    Wide begin = 0, end = frame.width;
    for (std::size_t i = 0; i < 3; ++i) {
      const ScreenPoint from = p[(i + 1) % 3], to = p[(i + 2) % 3];
      const bool owns_edge = to.y < from.y || (to.y == from.y && to.x > from.x);
      // weight + x step >= 0 for a left or top edge, > 0 for the others.
      const Wide step = right.weight[i] - origin.weight[i],
                 weight =
                     origin.weight[i] + Wide{y} * (down.weight[i] - origin.weight[i]) - (owns_edge ? 0 : 1);
      if (step > 0)
        begin = std::max(begin, -floor_of(weight, step));
      else if (step < 0)
        end = std::min(end, floor_of(weight, -step) + 1);
      else if (weight < 0)
        end = 0;
    }
    if (begin < end) span(y, static_cast<std::int64_t>(begin), static_cast<std::int64_t>(end));
  }
}

/// Calls pixel(x, y) for each pixel of the frame that the triangle covers, line by line.
template <class Pixel>
void for_each_covered(const std::array<ScreenPoint, 3>& p, int unit_bits, FrameSize frame, Pixel&& pixel) {
  for_each_covered_span(p, unit_bits, frame, [&](std::int64_t y, std::int64_t begin, std::int64_t end) {
    for (std::int64_t x = begin; x < end; ++x) pixel(x, y);
  });
}

/// Interpolates between the values at three vertices.
inline long double linear(const std::array<long double, 3>& barycentric,
                          const std::array<long double, 3>& value) {
  return barycentric[0] * value[0] + barycentric[1] * value[1] + barycentric[2] * value[2];
}

/// Interpolates between the values at three vertices and at the midpoints of the edges 1-2, 1-3, 2-3
/// (quadratic element with six samples).
inline long double quadratic(const std::array<long double, 3>& barycentric,
                             const std::array<long double, 6>& value) {
  const auto& [a, b, c] = barycentric;
  return value[0] * a * (2 * a - 1) + value[1] * b * (2 * b - 1) + value[2] * c * (2 * c - 1) +
         4 * (value[3] * a * b + value[4] * a * c + value[5] * b * c);
}

/// A point of the surface, perspective-correct.
struct ExactSurface {
  LongVec position_world, normal_world;  ///< the normal is not unit; it may vanish
  long double z;
};

/// The surface at a point of the screen in 1/2^(unit_bits + 1) pixels.
inline ExactSurface exact_surface(const ScreenTriangle& t, Wide x_half, Wide y_half) {
  const auto screen = barycentric(screen_points(t), x_half, y_half).real();
  ExactSurface s{LongVec(0), LongVec(0), 0};
  long double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const long double weight = screen[i] * (long double)t.vertex[i].inverse_w;
    sum += weight;
    s.position_world += weight * LongVec(t.vertex[i].position_world);
    s.normal_world += weight * LongVec(t.vertex[i].normal_world);
    s.z += screen[i] * (long double)t.vertex[i].z;
  }
  s.position_world /= sum;
  s.normal_world /= sum;
  return s;
}

/// The surface at a pixel's centre.
inline ExactSurface surface(const ScreenTriangle& t, int unit_bits, std::int64_t x, std::int64_t y) {
  return exact_surface(t, centre(x, unit_bits), centre(y, unit_bits));
}

/// The unit normal at a pixel. If the interpolated normal is only rounding noise, returns the triangle's own.
inline LongVec unit_normal(const ScreenTriangle& t, const ExactSurface& s) {
  constexpr long double c_noise = 1e-8L;
  const long double length = glm::length(s.normal_world);
  if (length > c_noise) return s.normal_world / length;
  const LongVec a(t.vertex[0].position_world), b(t.vertex[1].position_world), c(t.vertex[2].position_world);
  return glm::normalize(glm::cross(c - a, b - a));
}

}  // namespace halfway::stability

// SPDX-License-Identifier: Apache-2.0
// The specification: the papers' formulas at one pixel, in exact integers or long double, without any of the
// tested code. Figures are measured against its values.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <numbers>

#include "frame/frame_size.hpp"
#include "scene/scene.hpp"
#include "setup/edge.hpp"
#include "setup/init_vector.hpp"
#include "setup/screen_triangle.hpp"

namespace halfway::stability {

using Wide = __int128;
using LongVec = glm::vec<3, long double>;

/// Exact barycentric coordinates of a point over one divisor, which is twice the area. The point is in
/// 1/2^(unit_bits + 1) pixels, the vertices in 1/2^unit_bits pixels.
struct ExactBarycentric {
  std::array<Wide, 3> weight;
  Wide sum;
  std::array<long double, 3> real() const {
    return {(long double)weight[0] / (long double)sum, (long double)weight[1] / (long double)sum,
            (long double)weight[2] / (long double)sum};
  }
};

inline ExactBarycentric barycentric(const std::array<ScreenPoint, 3>& p, Wide x_half, Wide y_half) {
  const auto twice_area = [](Wide ax, Wide ay, Wide bx, Wide by, Wide cx, Wide cy) {
    return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
  };
  std::array<Wide, 3> x, y;
  for (std::size_t i = 0; i < 3; ++i) x[i] = 2 * Wide{p[i].x}, y[i] = 2 * Wide{p[i].y};
  return {
      {twice_area(x_half, y_half, x[1], y[1], x[2], y[2]), twice_area(x[0], y[0], x_half, y_half, x[2], y[2]),
       twice_area(x[0], y[0], x[1], y[1], x_half, y_half)},
      twice_area(x[0], y[0], x[1], y[1], x[2], y[2])};
}

/// The centre of pixel `at`, in 1/2^(unit_bits + 1) pixels.
constexpr Wide centre(std::int64_t at, int unit_bits) {
  return (2 * Wide{at} + 1) << unit_bits;
}

/// Returns whether the pixel's centre lies in the triangle, by the top-left rule: a centre on an edge belongs
/// to the triangle to the right of the edge, or below it if the edge is level.
inline bool covers(std::array<ScreenPoint, 3> p, int unit_bits, std::int64_t x, std::int64_t y) {
  ExactBarycentric b = barycentric(p, centre(x, unit_bits), centre(y, unit_bits));
  if (b.sum == 0) return false;
  if (b.sum < 0) {
    std::swap(p[1], p[2]);
    b = barycentric(p, centre(x, unit_bits), centre(y, unit_bits));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (b.weight[i] < 0) return false;
    if (b.weight[i] > 0) continue;
    // The edge opposite to vertex i. Corners are clockwise on a screen with y downwards, so the inside is to
    // the right of the edge's direction.
    const ScreenPoint from = p[(i + 1) % 3], to = p[(i + 2) % 3];
    const bool left = to.y < from.y, top = to.y == from.y && to.x > from.x;
    if (!left && !top) return false;
  }
  return true;
}

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

/// The factor of k_s: (N.H)^n, (R.V)^n, or P F G/(4 N.V) of Cook and Torrance, where N.L is cancelled
/// (spherical, equations 4 to 7). All vectors have unit length. The result is not bounded.
inline long double specular(const Material& m, const LongVec& n, const LongVec& l, const LongVec& v) {
  const auto power = [&](long double base) {
    return base > 0 ? std::pow(std::min(base, 1.0L), (long double)m.exponent) : 0.0L;
  };
  const long double n_dot_l = glm::dot(n, l);
  if (m.brdf == Brdf::phong) return power(2 * n_dot_l * glm::dot(n, v) - glm::dot(l, v));
  const LongVec sum = l + v;
  const long double length = glm::length(sum);
  if (!(length > 0)) return 0;
  const LongVec h = sum / length;
  const long double n_dot_h = glm::dot(n, h);
  if (m.brdf == Brdf::blinn) return power(n_dot_h);
  const long double n_dot_v = glm::dot(n, v), v_dot_h = glm::dot(v, h);
  if (!(n_dot_v > 0) || !(n_dot_h > 0)) return 0;
  const LongVec across = glm::cross(n, h);
  const long double cos2 = n_dot_h * n_dot_h, m2 = (long double)m.roughness * m.roughness;
  const long double density = std::exp(-glm::dot(across, across) / (cos2 * m2)) /
                              (std::numbers::pi_v<long double> * m2 * cos2 * cos2);
  const long double fresnel =
      m.reflectance + (1 - (long double)m.reflectance) * std::pow(1 - std::min(v_dot_h, 1.0L), 5.0L);
  const long double shadowed = 2 * n_dot_h * std::min(n_dot_v, n_dot_l) / v_dot_h;
  return density * fresnel * std::min(shadowed, 1.0L) / (4 * n_dot_v);
}

/// The radiance I_a k_a + sum of I (k_d N.L + k_s specular) over the lights in front of the surface
/// (spherical, equations 1 to 3; processors, section 2), not clamped. `normal` has unit length. A light at
/// the point, within the precision of doubles, has no direction and adds nothing.
inline LongVec radiance(const Scene& scene, const Material& m, const LongVec& position,
                        const LongVec& normal) {
  LongVec sum = LongVec(scene.ambient) * LongVec(m.colour) * (long double)m.ambient;
  const LongVec to_eye = LongVec(scene.camera.eye_world) - position;
  const long double eye_distance = glm::length(to_eye);
  const LongVec v = eye_distance > 0 ? to_eye / eye_distance : normal;
  const long double noise = 4 * std::numeric_limits<double>::epsilon() * glm::length(position);
  const auto add = [&](const LongVec& to_light, const LongVec& intensity, long double least = 0) {
    const long double distance = glm::length(to_light);
    if (!(distance > least)) return;
    const LongVec l = to_light / distance;
    const long double n_dot_l = glm::dot(normal, l);
    if (!(n_dot_l > 0)) return;
    sum += intensity * (LongVec(m.colour) * ((long double)m.diffuse * std::min(n_dot_l, 1.0L)) +
                        LongVec(m.specular_colour) * ((long double)m.specular * specular(m, normal, l, v)));
  };
  for (const DirectionalLight& light : scene.directional)
    add(LongVec(light.to_light_world), LongVec(light.intensity));
  for (const PositionalLight& light : scene.positional)
    add(LongVec(light.position_world) - position, LongVec(light.intensity), noise);
  for (const SpotLight& light : scene.spots) {
    const LongVec to_light = LongVec(light.position_world) - position;
    const long double distance = glm::length(to_light);
    if (!(distance > noise)) continue;
    const long double cosine = -glm::dot(to_light, LongVec(light.axis_world)) / distance,
                      inner = light.cos_inner, outer = light.cos_outer;
    long double share = cosine >= inner ? 1.0L : 0.0L;
    if (cosine < inner && cosine > outer) {
      const long double t = (cosine - outer) / (inner - outer);
      share = t * t * (3 - 2 * t);
    }
    add(to_light, share * LongVec(light.intensity));
  }
  return sum;
}

}  // namespace halfway::stability

// SPDX-License-Identifier: Apache-2.0
// The specification: coverage and illumination at one pixel by their equations, in exact integers and long
// double, without any of the tested code. It only reads the plain fields of a scene.
//
//  coverage, top-left rule        Akenine-Moller, Haines, Hoffman: Real-Time Rendering, 4th ed., section
//                                 23.1; Pineda: A Parallel Algorithm for Polygon Rasterization (1988)
//  Blinn, Phong                   spherical, equations 4 and 5; Blinn: Models of Light Reflection (1977)
//  Cook-Torrance                  spherical, equation 7; Cook, Torrance: A Reflectance Model for Computer
//                                 Graphics (1982), with Beckmann's distribution and Schlick's approximation
//                                 of Fresnel's term (1994)
//  positional lights, spots       processors, table of terms; no fall-off with distance
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <numbers>
#include <string_view>
#include <utility>

#include "scene/scene.hpp"

namespace halfway::oracle {

using Real = long double;
using Vector = glm::vec<3, Real>;
using Wide = __int128;

/// The name of a fault in c_faults (oracle_test.cpp) that is put into the specification; empty: none.
using Fault = std::string_view;

/// A decision is in doubt if the real number that decides is this close to the limit: rounding may then
/// decide differently.
inline constexpr Real c_doubt = 1e-9L;

// ---- Coverage

/// Exact barycentric coordinates of a point over one divisor, which is twice the area. The point is in
/// 1/2^(unit_bits + 1) pixels, the vertices in 1/2^unit_bits pixels.
struct ExactBarycentric {
  std::array<Wide, 3> weight;
  Wide sum;
  std::array<Real, 3> real() const {
    return {Real(weight[0]) / Real(sum), Real(weight[1]) / Real(sum), Real(weight[2]) / Real(sum)};
  }
};

template <class Point>
ExactBarycentric barycentric(const std::array<Point, 3>& p, Wide x_half, Wide y_half) {
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
template <class Point>
bool covers(std::array<Point, 3> p, int unit_bits, std::int64_t x, std::int64_t y, Fault fault = {}) {
  const auto at = [&](std::int64_t pixel) {
    return fault == "pixel_corners" ? Wide{pixel} << (unit_bits + 1) : centre(pixel, unit_bits);
  };
  ExactBarycentric b = barycentric(p, at(x), at(y));
  if (b.sum == 0) return false;
  if (b.sum < 0) {
    std::swap(p[1], p[2]);
    b = barycentric(p, at(x), at(y));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (b.weight[i] < 0) return false;
    if (b.weight[i] > 0 || fault == "closed_edges") continue;
    // The edge opposite to vertex i. Corners are clockwise on a screen with y downwards, so the inside is to
    // the right of the edge's direction.
    const Point &from = p[(i + 1) % 3], &to = p[(i + 2) % 3];
    const bool left = to.y < from.y, top = to.y == from.y && to.x > from.x;
    if ((left || top) == (fault == "bottom_right_rule")) return false;
  }
  return true;
}

// ---- Illumination

/// The factor of k_s: (N.H)^n, (R.V)^n, or P F G/(4 N.V) of Cook and Torrance, where N.L is cancelled. All
/// vectors have unit length, and N.L > 0. The result is not bounded.
inline Real specular(const Material& m, const Vector& n, const Vector& l, const Vector& v, Fault fault = {}) {
  const auto has = [&](Fault f) { return f == fault; };
  const auto power = [&](Real base) {
    return base > 0 ? std::pow(std::min(base, 1.0L), Real(m.exponent) + has("exponent_plus_one")) : 0.0L;
  };
  const Real nl = dot(n, l);
  // R = 2 (N.L) N - L; (R.V)^n.
  if (m.brdf == Brdf::phong) return power(has("phong_by_light") ? dot(l, v) : 2 * nl * dot(n, v) - dot(l, v));
  // H = (L + V)/|L + V|; (N.H)^n.
  const Vector sum = (has("halfway_of_normal") ? n : l) + v;
  const Real size = length(sum);
  if (!(size > 0)) return 0;
  const Vector h = sum / (has("halfway_not_unit") ? 2.0L : size);
  const Real nh = dot(n, h);
  if (m.brdf == Brdf::blinn) return power(nh);
  const Real nv = dot(n, v), vh = dot(v, h);
  if (!(nv > 0) || !(nh > 0)) return 0;
  // P = exp(-tan^2/m^2) / (pi m^2 cos^4).
  const Vector across = cross(n, h);
  const Real cos2 = nh * nh, m2 = Real(m.roughness) * m.roughness;
  const Real density = std::exp(-dot(across, across) / (cos2 * m2)) /
                       ((has("beckmann_without_pi") ? 1 : std::numbers::pi_v<Real>)*m2 * cos2 *
                        (has("beckmann_squared_cosine") ? 1 : cos2));
  // F = F0 + (1 - F0)(1 - V.H)^5.
  const Real fresnel =
      m.reflectance + (1 - Real(m.reflectance)) *
                          std::pow(1 - std::min(vh, 1.0L), has("fresnel_of_fourth_power") ? 4.0L : 5.0L);
  // G = min{1, 2 (N.H)(N.V)/(V.H), 2 (N.H)(N.L)/(V.H)}.
  const Real masking = has("masking_missing") ? 1 : std::min(2 * nh * std::min(nv, nl) / vh, 1.0L);
  return density * fresnel * masking / (4 * nv);
}

enum class Kind { directional, positional, spot };
struct Light {
  Kind kind;
  Vector place;  ///< of a directional light: the direction to the light
  Vector intensity;
  Vector axis{};  ///< of a spot: the direction in which it shines
  Real cos_inner = 0, cos_outer = 0;

  bool is_far() const { return kind == Kind::directional; }
};

template <class Each>
void for_each_light(const Scene& scene, Each&& each) {
  for (const auto& l : scene.directional)
    each(Light{Kind::directional, Vector(l.to_light_world), Vector(l.intensity)});
  for (const auto& l : scene.positional)
    each(Light{Kind::positional, Vector(l.position_world), Vector(l.intensity)});
  for (const auto& l : scene.spots)
    each(Light{Kind::spot, Vector(l.position_world), Vector(l.intensity), Vector(l.axis_world), l.cos_inner,
               l.cos_outer});
}

/// A spot's share: 1 within the inner cone, 0 outside the outer cone, 3 t^2 - 2 t^3 of the cosine between.
inline Real share_of(const Light& spot, const Vector& l, Fault fault, bool& doubtful) {
  const Real cosine = dot(l, spot.axis) * (fault == "spot_backwards" ? 1 : -1),
             width = spot.cos_inner - spot.cos_outer;
  if (!(width > 0)) {
    doubtful |= std::abs(cosine - spot.cos_inner) < c_doubt;
    return Real(cosine >= spot.cos_inner);
  }
  const Real t = std::clamp((cosine - spot.cos_outer) / width, Real(0), Real(1));
  if (fault == "spot_linear") return t;
  return fault == "spot_without_edge" ? Real(t > 0) : t * t * (3 - 2 * t);
}

/// Every light reaches every point.
inline constexpr auto c_no_shadows = [](const Light&, bool&) { return true; };

/// The radiance I_a k_a + sum of I (k_d N.L + k_s specular) over the lights in front of the surface that
/// reach it (spherical, equations 1 to 3; processors, section 2), not clamped. The ambient and diffuse parts
/// have the material's colour; highlights have their own. `n` has unit length. A light at the point, within
/// the precision of doubles, has no direction and adds nothing. Sets `doubtful` if a decision is in doubt.
template <class Reaches>
Vector radiance(const Scene& scene, const Material& m, const Vector& position, const Vector& n,
                Reaches&& reaches, Fault fault, bool& doubtful) {
  const auto has = [&](Fault f) { return f == fault; };
  const Vector own_colour(m.colour), specular_colour(m.specular_colour), eye(scene.camera.eye_world),
      to_eye = has("eye_at_infinity") ? eye - Vector(scene.camera.target_world) : eye - position;
  const Vector v = length(to_eye) > 0 ? normalize(to_eye) : n;
  const Real noise = 4 * std::numeric_limits<double>::epsilon() * length(position);
  Vector sum(0);
  if (!has("ambient_missing")) sum = Real(m.ambient) * Vector(scene.ambient) * own_colour;
  if (!has("emission_missing")) sum += Vector(m.emission);
  int number = 0;
  oracle::for_each_light(scene, [&](const Light& light) {
    if (number++ == 1 && has("second_light_missing")) return;
    const bool is_far = light.is_far() || has("positional_is_directional");
    const Vector way = is_far ? light.place : light.place - position;
    const Real distance = length(way);
    if (!(distance > (is_far ? 0 : noise))) return;
    const Vector l = way / distance;
    Vector intensity = light.intensity;
    if (has("falls_off_by_distance") && !light.is_far()) intensity /= distance * distance;
    if (light.kind == Kind::spot) intensity *= share_of(light, l, fault, doubtful);
    if (intensity == Vector(0)) return;
    const Real nl = std::min(dot(n, l), 1.0L);
    // A highlight may be non-zero at the horizon.
    doubtful |= std::abs(nl) < c_doubt;
    const bool lit = nl > 0;
    if ((lit || has("averted_faces_lit")) && !reaches(light, doubtful)) return;
    if (lit || has("diffuse_unclamped"))
      sum +=
          m.diffuse * nl * intensity * (has("diffuse_in_all_channels") ? Vector(own_colour.x) : own_colour);
    if (lit || has("highlight_below_horizon"))
      sum += m.specular * specular(m, n, l, v, fault) * intensity *
             (has("specular_takes_colour") ? own_colour : specular_colour);
  });
  return sum;
}
inline Vector radiance(const Scene& scene, const Material& m, const Vector& position, const Vector& n) {
  bool doubtful = false;
  return radiance(scene, m, position, n, c_no_shadows, {}, doubtful);
}

}  // namespace halfway::oracle

// SPDX-License-Identifier: Apache-2.0
#include "setup/proved_bound.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "setup/setup.hpp"
#include "shading/shade.hpp"

namespace halfway {
namespace {

constexpr double c_unbounded = std::numeric_limits<double>::infinity();

// Bounds of the derivatives 0 to 3 of a unit vector along an edge: the parts across and along the vector.
struct Turn {
  std::array<double, 4> across{0, 0, 0, 0}, along{1, 0, 0, 0};
  double whole(std::size_t order) const { return std::hypot(across[order], along[order]); }
};

// Bounds of a function that is not negative and of its derivatives 1 to 3. Infinite if it has a jump or a
// bend.
struct Course {
  double most = 0, first = 0, second = 0, third = 0;
  double error() const { return std::min({c_of_range * most, c_of_second * second, c_of_third * third}); }
};
Course jump(double most) {
  return {most, c_unbounded, c_unbounded, c_unbounded};
}
Course operator*(double factor, const Course& a) {
  if (factor <= 0) return {};
  return {factor * a.most, factor * a.first, factor * a.second, factor * a.third};
}
Course operator+(const Course& a, const Course& b) {
  return {a.most + b.most, a.first + b.first, a.second + b.second, a.third + b.third};
}
Course operator*(const Course& a, const Course& b) {
  if (a.most <= 0 || b.most <= 0) return {};
  const auto product = [](double x, double y) { return x > 0 && y > 0 ? x * y : 0; };
  return {a.most * b.most, product(a.first, b.most) + product(a.most, b.first),
          product(a.second, b.most) + 2 * product(a.first, b.first) + product(a.most, b.second),
          product(a.third, b.most) + 3 * product(a.second, b.first) + 3 * product(a.first, b.second) +
              product(a.most, b.third)};
}

// Of a linear field with these values at the vertices, normalized. Empty if it may vanish.
std::optional<Turn> turn_of(const std::array<glm::dvec3, 3>& v) {
  const double least = distance_from_origin(v[0], v[1], v[2]);
  if (!(least > 1e-6 * std::max({glm::length(v[0]), glm::length(v[1]), glm::length(v[2])}))) return {};
  double w = 0, r = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 edge = (v[(i + 1) % 3] - v[i]) / least, at = v[k] / least;
      w = std::max(w, glm::length(glm::cross(at, edge)));
      r = std::max(r, std::abs(glm::dot(at, edge)));
    }
  return Turn{{0, w, 2 * w * r, w * std::max(6 * r * r, 3 * w * w)}, {1, 0, w * w, 6 * w * w * r}};
}

// Of L + V, normalized, if its length is at least `least`. The derivatives of s/|s| by s, in the first,
// second and third order, are at most 1/|s|, 2/(sqrt(3) |s|^2) and 3/|s|^3; across s the second is at most
// 1/|s|^2.
Turn halfway_turn(const Turn& l, const Turn& v, double least) {
  const double first = (l.across[1] + v.across[1]) / least, second = (l.whole(2) + v.whole(2)) / least,
               third = (l.whole(3) + v.whole(3)) / least;
  const double across = second + first * first;
  return {{0, first, across, third + 3.47 * first * second + 3 * first * first * first},
          {1, 0, first * first, 3 * first * across}};
}

// Of the reflected light 2 (N.L) N - L.
Turn reflected_turn(const Turn& n, const Turn& l, const Course& n_dot_l) {
  const double first = 2 * n.across[1] + l.across[1],
               second = 2 * (n_dot_l.second + 2 * n_dot_l.first * n.across[1] + n.whole(2)) + l.whole(2),
               third = 2 * (n_dot_l.third + 3 * n_dot_l.second * n.across[1] +
                            3 * n_dot_l.first * n.whole(2) + n.whole(3)) +
                       l.whole(3);
  return {{0, first, second, third}, {1, 0, first * first, 3 * first * second}};
}

// Derivatives of the cosine between two unit vectors, where its sine is at most `sine`.
Course cosine_course(const Turn& a, const Turn& b, double most, double sine) {
  const auto term = [&](std::size_t i, std::size_t j) {
    return a.across[i] * b.across[j] + sine * (a.across[i] * b.along[j] + a.along[i] * b.across[j]) +
           a.along[i] * b.along[j];
  };
  return {most, sine * (a.across[1] + b.across[1]), term(2, 0) + 2 * term(1, 1) + term(0, 2),
          term(3, 0) + 3 * term(2, 1) + 3 * term(1, 2) + term(0, 3)};
}

// Greatest r exp(-d^2/2) and r |3 - r^2| exp(-d^2/2) with r <= d and d >= x.
double first_beyond(double x) {
  return x < 1 ? 0.6066 : x * std::exp(-0.5 * x * x);
}
double third_beyond(double x) {
  const double x2 = x * x, gauss = std::exp(-0.5 * x2);
  const double nearest = gauss * (x <= 1 ? x * (3 - x2) : x <= 2 ? 2 : x * (x2 - 3));  // d = x
  if (x2 < 3 - std::sqrt(6.0)) return std::max(nearest, 1.3802);
  return x2 < 3 + std::sqrt(6.0) ? std::max(nearest, 0.3754) : nearest;
}

// cos^n of the angle between the unit vectors a and b, whose differences at the samples are w: with D = a -
// b, cos = 1 - |D|^2/2 = g. Greatest third derivative: with q = D.D' = -g' and g'' = -|D'|^2 - c,
//   n (n-1) g^(n-3) q (3 g |D'|^2 - (n-2) q^2) + 3 n (n-1) g^(n-2) q c + n g^(n-1) g'''.
Course power_course(double n, const Turn& a, const Turn& b, const SampleVectors& w, double most,
                    double least_length) {
  const double second = a.whole(2) + b.whole(2);
  const double chord =
      std::max({glm::length(w[1] - w[0]), glm::length(w[2] - w[0]), glm::length(w[2] - w[1])});
  const double d1 = std::min(a.across[1] + b.across[1], chord + second);  // of |D'|
  double longest = 0;
  for (const glm::dvec3& v : w) longest = std::max(longest, glm::length(v));
  longest = std::min(2.0, longest + c_of_plane / 4 * second);
  const double least_cosine = 1 - 0.5 * longest * longest, sine = std::min(1.0, longest);
  if (least_cosine <= 0 && n < 3) return jump(most);
  const double c =
      std::min(2.0, 0.5 * longest * longest) * (a.across[1] * a.across[1] + b.across[1] * b.across[1]) +
      sine * (a.across[2] + b.across[2]);
  const double g3 = cosine_course(a, b, 1, sine).third;
  const double greatest = 1 - 0.5 * least_length * least_length;
  const auto power_of_g = [&](double e) {
    return std::pow(std::max(0.0, e >= 0 ? greatest : least_cosine), e);
  };
  const double q = n > 3.5 ? first_beyond(least_length * std::sqrt(n - 2)) / std::sqrt(n - 2)
                           : longest * power_of_g(n - 2);  // |q| g^(n-2) / |D'|
  Course f{most, n * power_of_g(n - 1) * longest * d1,
           n * (n - 1) * q * longest * d1 * d1 + n * power_of_g(n - 1) * (d1 * d1 + c), 0};
  // With |q| = r |D'| and y = r sqrt(n-3): 3 g - (n-2) r^2 is at most 3 - y^2 and at least 3 - y^2 - 2.5
  // |D|^2.
  const double k = std::sqrt(n - 3), x = least_length * k;
  const double main = n > 3.5 ? (third_beyond(x) + 2.5 * longest * longest * first_beyond(x)) / k
                              : power_of_g(n - 3) * longest * (3 + std::abs(n - 2) * longest * longest);
  f.third = n * (n - 1) * (main * d1 * d1 * d1 + 3 * q * d1 * c) + n * power_of_g(n - 1) * g3;
  return f;
}

// Least length of a field of unit vectors' sums or differences, whose second derivative is bounded, on the
// triangle.
double least_length(const SampleVectors& w, double second) {
  return std::max(0.0, flat_distance(w) - c_of_plane / 4 * second);
}

// A cosine's range on the triangle.
ValueRange range_of(const SampleVectors& a, const SampleVectors& b, double second) {
  ValueRange r;
  for (std::size_t i = 0; i < 6; ++i) r.take(glm::dot(a[i], b[i]));
  return {r.least - c_of_plane / 4 * second, r.most + c_of_plane / 4 * second};
}
double greatest_sine(const ValueRange& cosine) {
  return cosine.least > 0 ? std::sqrt(std::max(0.0, 1 - cosine.least * cosine.least)) : 1.0;
}

// smoothstep of (cosine - cos_outer)/(cos_inner - cos_outer).
Course share_of(const LightCone& cone, const Turn& to_light, const SampleVectors& to_light_world) {
  SampleVectors axis, from_light;
  axis.fill(cone.axis_world);
  for (std::size_t i = 0; i < 6; ++i) from_light[i] = -to_light_world[i];
  const Course c = cosine_course(to_light, {}, 1, 1);
  const ValueRange r = range_of(from_light, axis, c.second);
  if (r.most < cone.cos_outer) return {};
  if (r.least > cone.cos_inner) return {1, 0, 0, 0};
  const double width = cone.cos_inner - cone.cos_outer;
  if (!(width > 0)) return jump(1);
  const double d1 = c.first / width, d2 = c.second / width, d3 = c.third / width;
  const bool between = r.least > cone.cos_outer && r.most < cone.cos_inner;
  return {cone_share(cone, r.most), 1.5 * d1, 6 * d1 * d1 + 1.5 * d2,
          between ? 12 * d1 * d1 * d1 + 18 * d1 * d2 + 1.5 * d3 : c_unbounded};
}

// The triangle with its normals and directions to the eye, or to a light.
struct UnitField {
  std::optional<Turn> turn;
  SampleVectors unit_world;
};
template <class At>
std::array<glm::dvec3, 3> at_vertices(const SampledTriangle& t, At&& at) {
  return {at(t.surface[0]), at(t.surface[1]), at(t.surface[2])};
}
UnitField normal_field(const SampledTriangle& t) {
  UnitField n{turn_of(at_vertices(
                  t, [](const SurfacePoint& s) { return s.inverse_w * s.normal_length * s.normal_world; })),
              {}};
  for (std::size_t i = 0; i < 6; ++i) n.unit_world[i] = t.surface[i].normal_world;
  // A flat triangle has its own normal everywhere.
  if (std::none_of(t.surface.begin(), t.surface.begin() + 3,
                   [](const SurfacePoint& s) { return s.is_smooth(); }))
    n.turn = Turn{};
  return n;
}
UnitField field_to(const SampledTriangle& t, const LightPoint& point) {
  if (point.w == 0.0) return {Turn{}, directions_to(t, point)};
  return {turn_of(at_vertices(
              t, [&](const SurfacePoint& s) { return s.inverse_w * point.way_from(s.position_world); })),
          directions_to(t, point)};
}

// The specular factor, for a light that shines on the whole triangle.
Course specular_course(const Material& m, const SampledTriangle& t, const UnitField& n, const UnitField& v,
                       const UnitField& l, const Course& n_dot_l) {
  SampleVectors sum;
  for (std::size_t i = 0; i < 6; ++i) sum[i] = l.unit_world[i] + v.unit_world[i];
  const double length = least_length(sum, l.turn->whole(2) + v.turn->whole(2));
  const Course n_dot_v = cosine_course(*n.turn, *v.turn, 1, 1);
  const double apart = 2 * std::acos(std::min(1.0, length / 2)),
               least_n_dot_v = range_of(n.unit_world, v.unit_world, n_dot_v.second).least;
  const auto most = [&](double chord) {
    return factor_bound(m, 2 * std::asin(std::min(1.0, chord / 2)), apart, least_n_dot_v);
  };
  const bool mirrored = m.brdf == Brdf::phong;
  if (!mirrored && length < 0.05) return jump(most(0));
  const Turn a = mirrored ? reflected_turn(*n.turn, *l.turn, n_dot_l) : *n.turn,
             b = mirrored ? *v.turn : halfway_turn(*l.turn, *v.turn, length);
  const SampleVectors w = off_peak(m, t, l.unit_world, v.unit_world);
  const double chord = least_length(w, a.whole(2) + b.whole(2));
  if (m.brdf == Brdf::cook_torrance) return jump(most(chord));
  return power_course(m.exponent, a, b, w, most(chord), chord);
}

// The error of one light, in colour steps.
double light_error(const Light& light, const Material& m, const SampledTriangle& t, const UnitField& n,
                   const UnitField& v) {
  const double diffuse = diffuse_amplitude(m, light.intensity),
               highlight = has_highlight(light.ref.kind) ? specular_amplitude(m, light.intensity) : 0;
  const UnitField l = field_to(t, light.point);
  if (!n.turn || !v.turn || !l.turn)
    return c_of_range * (diffuse + (highlight > 0 ? highlight * factor_bound(m, 0, 4, 0) : 0));

  Course n_dot_l = cosine_course(*n.turn, *l.turn, 1, 1);
  const ValueRange range = range_of(n.unit_world, l.unit_world, n_dot_l.second);
  if (range.most <= 0) return 0;  // all normals face away from the light
  n_dot_l = cosine_course(*n.turn, *l.turn, std::min(1.0, range.most), greatest_sine(range));
  const bool terminator = range.least <= 0;
  Course factor = highlight > 0 ? specular_course(m, t, n, v, l, n_dot_l) : Course{};
  if (terminator) factor = jump(factor.most);
  if (light.cone) {
    const Course share = share_of(*light.cone, *l.turn, l.unit_world);
    return (share * (diffuse * (terminator ? jump(n_dot_l.most) : n_dot_l) + highlight * factor)).error();
  }
  double bend = n_dot_l.error();
  if (terminator) {
    // max(0, N.L) differs from max(0, x) with the plane x through N.L at the vertices as N.L does from x.
    ValueRange at_vertices;
    for (std::size_t i = 0; i < 3; ++i) at_vertices.take(glm::dot(n.unit_world[i], l.unit_world[i]));
    bend = std::min({c_of_range * n_dot_l.most, bend - c_of_range * range.least,
                     c_of_bend * at_vertices.width() + (1 + c_weights) * c_of_plane * n_dot_l.second});
  }
  return diffuse * bend + (highlight * factor).error();
}

}  // namespace

double proved_bound(const Scene& scene, std::span<const Light> lights, const Material& m,
                    const SampledTriangle& t) {
  for (const glm::dvec3& r : t.radiance)
    if (std::max({r.x, r.y, r.z}) > c_largest_sample / 255) return c_unbounded;
  const UnitField n = normal_field(t), v = field_to(t, LightPoint{scene.camera.eye_world, 1.0});
  double sum = 0;
  for (const Light& light : lights) sum += light_error(light, m, t, n, v);
  return sum;
}

}  // namespace halfway

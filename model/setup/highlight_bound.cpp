// SPDX-License-Identifier: Apache-2.0
#include "setup/highlight_bound.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <optional>

#include "scene/lights.hpp"
#include "shading/shade.hpp"

namespace halfway {
namespace {

constexpr double c_pi = std::numbers::pi;

// All directions within `angle` of a unit axis. The direction of a convex combination of vectors lies in a
// cone around these vectors if that cone is narrower than a half space.
struct Cone {
  glm::dvec3 axis;
  double angle;
};

// Accurate for small angles and for opposite vectors. acos of the dot product is not.
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return 2.0 * std::atan2(glm::length(a - b), glm::length(a + b));
}

// The cone around unit vectors. Empty if the vectors point in all directions, so that no cone bounds their
// combinations.
std::optional<Cone> cone_around(const std::array<glm::dvec3, 3>& directions) {
  const glm::dvec3 sum = directions[0] + directions[1] + directions[2];
  const double length = glm::length(sum);
  if (length < 1e-6) return std::nullopt;
  Cone cone{sum / length, 0.0};
  for (const glm::dvec3& d : directions) cone.angle = std::max(cone.angle, angle_between(cone.axis, d));
  if (cone.angle >= c_pi / 2) return std::nullopt;
  return cone;
}

// The greatest part of a derivative's or a jump's effect that a quadratic through six samples may miss, for a
// side of length one. Along an edge x(x - 1/2)(x - 1)/6 is at most 0.008; multiply by 1.38, the third
// derivative of exp(-x^2/2). The bend max(0, x - a) is missed by up to 0.094, and so is the parabola with
// second derivative 6 that starts at a. The values are rounded up to hold for random triangles, which have
// slightly larger errors in their interior: see highlight_bound_test.cpp.
constexpr double c_third_derivative = 0.009;
constexpr double c_bend = 0.1;
constexpr double c_spot_edge = 0.1;
// N.L has no peak that could be missed, and the sample at the centroid helps: a smaller value is enough.
constexpr double c_diffuse = 0.85 * c_third_derivative;
// The mixed terms of the third derivative of f(w(t)), relative to 1.38: 3 w' w'' with w'' = 8 u, and 0.61
// w''' with w''' = 96 u^2. u is the unevenness of w.
constexpr double c_second_derivative = 17.4;
constexpr double c_first_derivative = 42.4;
// Greatest distance of a curved field from four flat triangles through six samples, relative to the sag of
// the edges. A third would be enough for a quadratic field.
constexpr double c_sag = 0.5;
// N.L between the samples may exceed its values at the samples by this fraction of its range.
constexpr double c_overshoot = 0.1;

// The cone of directions from the three vertices to a point.
std::optional<Cone> cone_to(const SampledTriangle& t, const glm::dvec3& point_world) {
  std::array<glm::dvec3, 3> d;
  for (std::size_t i = 0; i < 3; ++i) {
    d[i] = point_world - t.surface[i].position_world;
    const double length = glm::length(d[i]);
    if (!(length > 0.0)) return std::nullopt;
    d[i] /= length;
  }
  return cone_around(d);
}

// The extent of a field of vectors w over the triangle, from its values at the six samples: its size, and a
// lower bound of |w|.
struct Extent {
  double width;         // twice the longest half edge: no edge is longer, however unevenly w varies along it
  double least;         // lower bound of |w|
  double uneven = 0.0;  // greatest distance, along the edge, of an edge's middle sample from the middle
};

// For each edge the samples at its two vertices and at its midpoint.
constexpr std::array<std::array<std::size_t, 3>, 3> c_edges = {{{0, 1, 3}, {0, 2, 4}, {1, 2, 5}}};

Extent extent(const SampleVectors& w) {
  double half_edge = 0.0, sag = 0.0, uneven = 0.0;
  for (const auto& [a, b, middle] : c_edges) {
    half_edge = std::max({half_edge, glm::length(w[middle] - w[a]), glm::length(w[middle] - w[b])});
    const glm::dvec3 off = w[middle] - 0.5 * (w[a] + w[b]), along = w[b] - w[a];
    sag += glm::length(off);
    const double length = glm::length(along);
    if (length > 0.0) uneven = std::max(uneven, std::abs(glm::dot(off, along)) / length);
  }
  // Use four flat triangles through the samples. The distance of a quadratic field from them is at most a
  // third of an edge's sag.
  return {2.0 * half_edge, std::max(0.0, flat_distance(w) - c_sag * sag), uneven};
}

// Close to its peak, Beckmann's exp(-tan^2/m^2) equals cos^n with n = 2/m^2.
double equivalent_exponent(const Material& m) {
  return m.brdf == Brdf::cook_torrance ? std::max(1.0, 2.0 / (m.roughness * m.roughness)) : m.exponent;
}

// The greatest third derivative of exp(-x^2/2) at distances of at least `x` from the peak, relative to its
// overall maximum. exp(-x^2/2) approximates cos^n close to its peak, with x = sqrt(n) angle.
double third_derivative_beyond(double x) {
  constexpr double c_greatest = 1.3801;  // at x^2 = 3 - sqrt(6)
  constexpr double c_second = 0.3753;    // at x^2 = 3 + sqrt(6)
  const double here = (3.0 - x * x) * x * std::exp(-0.5 * x * x);
  if (x * x < 3.0 - std::sqrt(6.0)) return 1.0;
  if (x * x < 3.0 + std::sqrt(6.0)) return std::max(here, c_second) / c_greatest;
  return -here / c_greatest;
}

// The same for the second and the first derivative.
double second_derivative_beyond(double x) {
  return x * x < 3.0 ? 1.0 : (x * x - 1.0) * std::exp(-0.5 * x * x);
}
double first_derivative_beyond(double x) {
  return x < 1.0 ? 1.0 : x * std::exp(0.5 - 0.5 * x * x);
}

// Error of a quadratic that approximates cos^n over a triangle `e` of angles: a fraction of the cube of the
// side times the third derivative of f(w(t)). An uneven w has the second derivative 8 u and, as a projective
// map, the third derivative 96 u^2/width.
double smooth_miss(const Extent& e, double exponent) {
  const double root = std::sqrt(exponent), s = e.width * root, x = e.least * root, u = e.uneven * root;
  if (s <= 0.0) return 0.0;
  return c_third_derivative *
         (s * s * s * third_derivative_beyond(x) + c_second_derivative * s * u * second_derivative_beyond(x) +
          c_first_derivative * u * u / s * first_derivative_beyond(x));
}

struct LightOnTriangle {
  std::optional<Cone> to_light;  // empty if the light is too close for a cone
  SampleVectors to_light_world;  // unit
  glm::dvec3 intensity;
  bool highlight;
};

struct ViewedTriangle {
  std::optional<Cone> normals, to_eye;
  SampleVectors to_eye_world;  // unit
};

// If the cones are wider than this, a field of angles is bounded by the cones alone, because six samples may
// miss its course.
constexpr double c_wide = 1.0;

// The greatest error at bends of a highlight whose maximum is 1. Cook-Torrance bends where masking changes to
// shadowing. The others bend where cos^n ends, which is visible for small n.
double missed_bends(const Material& m, const SampledTriangle& t, const ViewedTriangle& view,
                    const LightOnTriangle& light, const SampleVectors& w) {
  ValueRange r;
  for (std::size_t i = 0; i < 6; ++i) {
    const glm::dvec3 &n = t.surface[i].normal_world, &to_light = light.to_light_world[i],
                     &to_eye = view.to_eye_world[i];
    if (m.brdf == Brdf::cook_torrance)
      r.take(cook_torrance_geometry(glm::dot(n, to_light), glm::dot(n, to_eye),
                                    glm::dot(to_light + to_eye, to_light + to_eye)));
    else
      r.take(1.0 - 0.5 * glm::dot(w[i], w[i]));  // cosine of the angle whose chord is w
  }
  if (m.brdf == Brdf::cook_torrance) return c_bend * r.width() / std::max(r.most, 1e-9);
  if (r.least >= r.width() || r.most <= 0.0) return 0.0;
  return std::min(std::pow(r.most, m.exponent), c_bend * std::pow(r.width(), m.exponent));
}

double diffuse_amplitude(const Material& m, const LightOnTriangle& light) {
  return diffuse_amplitude(m, light.intensity);
}
double specular_amplitude(const Material& m, const LightOnTriangle& light) {
  return light.highlight ? specular_amplitude(m, light.intensity) : 0.0;
}

// Greatest error of one light's highlight between the samples, and its greatest value, in colour steps.
struct Missed {
  double steps = 0.0, greatest = 0.0;
};
Missed missed_specular(const Material& m, const SampledTriangle& t, const ViewedTriangle& view,
                       const LightOnTriangle& light, bool terminator) {
  const double amplitude = specular_amplitude(m, light);
  if (amplitude <= 0.0) return {};
  const auto anything = [&] {
    const double greatest = amplitude * factor_bound(m, 0.0, c_pi, 0.0);
    return Missed{greatest, greatest};
  };
  if (!view.normals || !view.to_eye || !light.to_light) return anything();
  const Cone &n = *view.normals, &v = *view.to_eye, &l = *light.to_light;
  const double apart = angle_between(l.axis, v.axis) + l.angle + v.angle;
  const double n_dot_v = std::cos(std::min(c_pi / 2, angle_between(n.axis, v.axis) + n.angle + v.angle));
  // Opening angle of the cone around w; angle between the axes of the vectors whose difference is w.
  double span, between;
  if (m.brdf == Brdf::phong) {
    span = 2.0 * n.angle + l.angle + v.angle;
    between = angle_between(2.0 * glm::dot(n.axis, l.axis) * n.axis - l.axis, v.axis);
  } else {
    if (apart >= 0.95 * c_pi) return anything();
    // H bisects the angle between L and V. A rotation of V moves H by 1/(2 cos(half the angle)) of its angle.
    span = n.angle + (l.angle + v.angle) / (2.0 * std::cos(apart / 2.0));
    between = angle_between(n.axis, glm::normalize(l.axis + v.axis));
  }
  const SampleVectors w = off_peak(m, t, light.to_light_world, view.to_eye_world);
  const Extent e = span < c_wide ? extent(w) : Extent{2.0 * span, std::max(0.0, between - span)};
  const double greatest = amplitude * factor_bound(m, e.least, apart, n_dot_v);
  // At the terminator a highlight ends abruptly. A Cook-Torrance highlight also does at the eye's horizon.
  if (terminator || (m.brdf == Brdf::cook_torrance && n_dot_v <= 0.0)) return {greatest, greatest};
  const double smooth =
      amplitude * factor_bound(m, 0.0, apart, n_dot_v) * smooth_miss(e, equivalent_exponent(m));
  const double bends =
      (m.brdf == Brdf::cook_torrance ? greatest : amplitude) * missed_bends(m, t, view, light, w);
  return {std::min(greatest, smooth + bends), greatest};
}

// N.L at the samples.
struct DiffuseCosines {
  std::array<double, 6> at_sample;
  ValueRange range;

  DiffuseCosines(const SampledTriangle& t, const LightOnTriangle& light) {
    for (std::size_t i = 0; i < 6; ++i) {
      at_sample[i] = glm::dot(t.surface[i].normal_world, light.to_light_world[i]);
      range.take(at_sample[i]);
    }
  }
  // Between the samples N.L may exceed its sampled range by the sag of the edges and a small margin.
  ValueRange between_samples() const {
    double slack = c_overshoot * range.width();
    for (const auto& [a, b, middle] : c_edges)
      slack += c_sag * std::abs(at_sample[middle] - 0.5 * (at_sample[a] + at_sample[b]));
    return {range.least - slack, range.most + slack};
  }
};

bool is_terminator(const ValueRange& between_samples) {
  return between_samples.least < 0.0 && between_samples.most > 0.0;
}
// max(0, N.L) has a bend at the terminator.
double bend_at_terminator(const ValueRange& between_samples, const ValueRange& at_samples) {
  return std::min({between_samples.most, -between_samples.least, c_bend * at_samples.width()});
}

// Normal minus direction to the light, at the samples.
SampleVectors off_light(const SampledTriangle& t, const LightOnTriangle& light) {
  SampleVectors w;
  for (std::size_t i = 0; i < 6; ++i) w[i] = t.surface[i].normal_world - light.to_light_world[i];
  return w;
}

// The part of the diffuse term's amplitude that six samples may miss without a terminator.
double smooth_diffuse_miss(const Extent& e) {
  return std::min(1.0, c_diffuse / c_third_derivative * smooth_miss({e.width, 0.0, e.uneven}, 1.0));
}

// The same including the diffuse term, for a light that shines on the whole triangle.
Missed missed_light(const Material& m, const SampledTriangle& t, const ViewedTriangle& view,
                    const LightOnTriangle& light) {
  DiffuseCosines n_dot_l(t, light);
  const double amplitude = diffuse_amplitude(m, light);
  double diffuse = amplitude;
  if (view.normals && light.to_light) {
    const double between = angle_between(view.normals->axis, light.to_light->axis);
    const double around = view.normals->angle + light.to_light->angle;
    if (between - around > c_pi / 2) return {};  // all normals face away from the light
    if (around > c_wide) {
      n_dot_l.range.take(std::cos(std::min(c_pi, between + around)));
      n_dot_l.range.take(std::cos(std::max(0.0, between - around)));
    }
    diffuse *= smooth_diffuse_miss(extent(off_light(t, light)));
  }
  const ValueRange between_samples = n_dot_l.between_samples();
  const bool terminator = is_terminator(between_samples);
  if (terminator) diffuse += amplitude * bend_at_terminator(between_samples, n_dot_l.range);
  const Missed specular = missed_specular(m, t, view, light, terminator);
  return {diffuse + specular.steps, amplitude * std::max(0.0, n_dot_l.range.most) + specular.greatest};
}

// A spot's cone on the triangle: its greatest share, and the error at its edge that six samples may miss.
struct SpotOnTriangle {
  double greatest, missed;
};
SpotOnTriangle spot_on_triangle(const LightCone& spot, const std::optional<Cone>& to_light,
                                const SampleVectors& to_light_world) {
  if (!to_light) return {1.0, 1.0};
  const double off_axis = angle_between(-to_light->axis, spot.axis_world);
  ValueRange angle;
  double width;
  if (to_light->angle < 0.5 * c_wide) {
    SampleVectors w;
    for (std::size_t i = 0; i < 6; ++i) {
      w[i] = -to_light_world[i] - spot.axis_world;
      angle.take(angle_between(-to_light_world[i], spot.axis_world));
    }
    const Extent e = extent(w);
    angle.take(e.least);
    width = e.width;
  } else {
    angle.take(std::max(0.0, off_axis - to_light->angle));
    angle.take(std::min(c_pi, off_axis + to_light->angle));
    width = 2.0 * to_light->angle;
  }
  const double greatest = cone_share(spot, std::cos(angle.least));
  const double fall = greatest - cone_share(spot, std::cos(angle.most));
  // The second derivative of smoothstep jumps by 6 over the square of its width at both ends.
  const double outer = std::acos(std::clamp(spot.cos_outer, -1.0, 1.0));
  const double inner = std::acos(std::clamp(spot.cos_inner, -1.0, 1.0));
  const double turn = width / std::max(1e-9, outer - inner);
  return {greatest, std::min(fall, c_spot_edge * turn * turn)};
}

// Greatest error of a spot light between the samples, in colour steps: of its light and at the edge of its
// cone.
double missed_spot(const Material& m, const SampledTriangle& t, const ViewedTriangle& view,
                   const LightOnTriangle& light, const LightCone& cone) {
  const Missed whole = missed_light(m, t, view, light);
  const SpotOnTriangle spot = spot_on_triangle(cone, light.to_light, light.to_light_world);
  return whole.steps * spot.greatest + whole.greatest * spot.missed;
}

// Directions at the vertices whose differences are at most this long span cones that are narrower than 1.05
// times this. Then no cone is too wide for the samples, if light and eye are at most 120 degrees apart.
constexpr double c_narrow_normals = 0.35;
constexpr double c_narrow_directions = 0.1;

bool is_narrow(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double most) {
  const auto length2 = [](const glm::dvec3& v) { return glm::dot(v, v); };
  if (length2(a) == 0.0) return false;  // no direction
  return std::max({length2(a - b), length2(b - c), length2(c - a)}) <= most * most;
}

// The extent of a field by a few square roots, up to rounding: the same width and unevenness, and a smaller
// lower bound.
Extent quick_extent(const SampleVectors& w) {
  const auto length2 = [](const glm::dvec3& v) { return glm::dot(v, v); };
  double half_edge2 = 0.0, uneven2 = 0.0, sag2 = 0.0, nearest2 = length2(w[0]);
  for (const glm::dvec3& v : w) nearest2 = std::min(nearest2, length2(v));
  for (const auto& [a, b, middle] : c_edges) {
    half_edge2 = std::max({half_edge2, length2(w[middle] - w[a]), length2(w[middle] - w[b])});
    const glm::dvec3 off = w[middle] - 0.5 * (w[a] + w[b]), along = w[b] - w[a];
    sag2 += length2(off);
    const double off_along = glm::dot(off, along), along2 = length2(along);
    if (along2 > 0.0) uneven2 = std::max(uneven2, off_along * off_along / along2);
  }
  // No point of the four flat triangles is farther from a sample than a half edge and the sags. The sum of
  // three sags is at most the root of three times the sum of their squares.
  const double half_edge = std::sqrt(half_edge2), sag = std::sqrt(3.0 * sag2);
  return {2.0 * half_edge, std::max(0.0, std::sqrt(nearest2) - half_edge - (1.0 + c_sag) * sag),
          std::sqrt(uneven2)};
}

constexpr double c_unknown = std::numeric_limits<double>::infinity();

// An upper bound of missed_light without cones. Infinite for wide triangles, for Cook-Torrance and for spots.
double quick_bound(const Material& m, const SampledTriangle& t, const ViewedTriangle& view,
                   const LightOnTriangle& light) {
  const auto& to_light = light.to_light_world;
  if (!is_narrow(to_light[0], to_light[1], to_light[2], c_narrow_directions)) return c_unknown;
  const DiffuseCosines n_dot_l(t, light);
  const ValueRange between_samples = n_dot_l.between_samples();
  const bool terminator = is_terminator(between_samples);
  double diffuse = smooth_diffuse_miss(quick_extent(off_light(t, light)));
  if (terminator) diffuse += bend_at_terminator(between_samples, n_dot_l.range);
  diffuse *= diffuse_amplitude(m, light);
  const double amplitude = specular_amplitude(m, light);
  if (amplitude <= 0.0) return diffuse;
  const glm::dvec3 l_plus_v = to_light[0] + view.to_eye_world[0];
  if (m.brdf == Brdf::cook_torrance || !(glm::dot(l_plus_v, l_plus_v) >= 1.0)) return c_unknown;
  const SampleVectors w = off_peak(m, t, light.to_light_world, view.to_eye_world);
  const Extent e = quick_extent(w);
  if (terminator) return diffuse + amplitude * factor_bound(m, e.least, c_pi, 0.0);
  return diffuse +
         amplitude * (smooth_miss({e.width, 0.0, e.uneven}, m.exponent) + missed_bends(m, t, view, light, w));
}

// At the samples; without a cone.
LightOnTriangle light_at_samples(const Light& light, const SampledTriangle& t) {
  return {{}, directions_to(t, light.point), light.intensity, has_highlight(light.ref.kind)};
}

// The sum of the lights' quick bounds.
double quick_sum(const Scene& scene, const Material& m, const SampledTriangle& t) {
  const auto& s = t.surface;
  if (!is_narrow(s[0].normal_world, s[1].normal_world, s[2].normal_world, c_narrow_normals)) return c_unknown;
  const ViewedTriangle view{{}, {}, directions_to(t, scene.camera.eye_world)};
  const auto& to_eye = view.to_eye_world;
  if (!is_narrow(to_eye[0], to_eye[1], to_eye[2], c_narrow_directions)) return c_unknown;
  double sum = 0.0;
  for_each_light(scene, [&](const Light& light) {
    sum += light.cone ? c_unknown : quick_bound(m, t, view, light_at_samples(light, t));
  });
  return sum;
}

}  // namespace

double centroid_error(const SampledTriangle& t, const glm::dvec3& centroid_radiance) {
  const auto& r = t.radiance;
  const glm::dvec3 quadratic = (4.0 * (r[3] + r[4] + r[5]) - (r[0] + r[1] + r[2])) / 9.0;
  // Two over-exposed values look the same.
  return c_steps *
         largest(glm::abs(glm::clamp(quadratic, 0.0, 1.0) - glm::clamp(centroid_radiance, 0.0, 1.0)));
}

double missed_highlight_bound(const Scene& scene, const Material& m, const SampledTriangle& t) {
  const ViewedTriangle view{
      cone_around({t.surface[0].normal_world, t.surface[1].normal_world, t.surface[2].normal_world}),
      cone_to(t, scene.camera.eye_world), directions_to(t, scene.camera.eye_world)};
  double missed = 0.0;
  for_each_light(scene, [&](const Light& light) {
    LightOnTriangle on_triangle = light_at_samples(light, t);
    const glm::dvec3& from = light.point.xyz_world;
    on_triangle.to_light = light.point.w == 0.0 ? Cone{from, 0.0} : cone_to(t, from);
    missed += light.cone ? missed_spot(m, t, view, on_triangle, *light.cone)
                         : missed_light(m, t, view, on_triangle).steps;
  });
  return missed;
}

bool may_miss_highlight(const Scene& scene, const Material& m, const SampledTriangle& t, double steps) {
  constexpr double c_margin = 1.001;  // for rounding
  return !(c_margin * quick_sum(scene, m, t) <= steps) && missed_highlight_bound(scene, m, t) > steps;
}

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
#include "setup/highlight_bound.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "scene/lights.hpp"
#include "shading/shade.hpp"

namespace halfway {
namespace {

constexpr double c_steps = 255.0;
constexpr double c_pi = std::numbers::pi;

// All directions within `angle` of a unit axis. Directions of a convex combination of vectors lie in the cone
// around the vectors themselves as long as that cone is narrower than a half space.
struct Cone {
  glm::dvec3 axis;
  double angle;
};

// Accurate for small and for opposed vectors alike, where acos of the dot product is not.
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return 2.0 * std::atan2(glm::length(a - b), glm::length(a + b));
}

// The cone around unit vectors; nothing where they point all ways, so that no cone bounds their combinations.
std::optional<Cone> cone_around(const std::array<glm::dvec3, 3>& directions) {
  const glm::dvec3 sum = directions[0] + directions[1] + directions[2];
  const double length = glm::length(sum);
  if (length < 1e-6) return std::nullopt;
  Cone cone{sum / length, 0.0};
  for (const glm::dvec3& d : directions) cone.angle = std::max(cone.angle, angle_between(cone.axis, d));
  if (cone.angle >= c_pi / 2) return std::nullopt;
  return cone;
}

// Parts of a derivative's or a jump's greatest effect that a quadratic through six samples may miss, for a
// side of one: along an edge x(x - 1/2)(x - 1)/6 is 0.008 at most, times 1.38, the third derivative of
// exp(-x^2/2); the bend max(0, x - a) is missed by 0.094, the parabola of second derivative 6 that begins at
// a by 0.094. Rounded up over random triangles, whose insides do a little worse: see
// highlight_bound_test.cpp.
constexpr double c_third_derivative = 0.009;
constexpr double c_bend = 0.1;
constexpr double c_spot_edge = 0.1;
// N.L has no peak to be missed, and the centroid's sample helps: less will do.
constexpr double c_diffuse = 0.85 * c_third_derivative;
// The mixed terms of the third derivative of f(w(t)), as parts of 1.38: 3 w' w'' with w'' = 8 u, and 0.61
// w''' with w''' = 96 u^2, u how uneven w is.
constexpr double c_second_derivative = 17.4;
constexpr double c_first_derivative = 42.4;
// Four flat triangles through six samples: how far a curved field leaves them, as a part of its
// edges' sag; a third would do for a quadratic one.
constexpr double c_sag = 0.5;
// N.L between the samples may go further than at them, by this part of its range.
constexpr double c_overshoot = 0.1;

struct Range {
  double least = 1e300, most = -1e300;
  void take(double v) {
    least = std::min(least, v);
    most = std::max(most, v);
  }
  double width() const { return most - least; }
};

double largest(const glm::dvec3& v) {
  return std::max({v.x, v.y, v.z});
}

// The three vertices' directions to a point.
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

// How a field of vectors w lies over the triangle, from its values at the six samples: its size in w, and how
// near it comes to zero.
struct Extent {
  double width;         // twice the longest half edge: no edge is longer, however unevenly it is run through
  double least;         // of |w|, below it nowhere
  double uneven = 0.0;  // how far an edge's middle sample lies from the middle, along the edge, at most
};

// Distance of the origin from a triangle in space: from its plane where the foot lies inside, else from an
// edge.
double distance_from_origin(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const auto to_edge = [](const glm::dvec3& p, const glm::dvec3& q) {
    const glm::dvec3 e = q - p;
    const double length2 = glm::dot(e, e);
    const double t = length2 > 0.0 ? std::clamp(-glm::dot(p, e) / length2, 0.0, 1.0) : 0.0;
    return glm::length(p + t * e);
  };
  const double edges = std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double length = glm::length(normal);
  const bool inside = glm::dot(glm::cross(a, b), normal) >= 0.0 &&
                      glm::dot(glm::cross(b, c), normal) >= 0.0 && glm::dot(glm::cross(c, a), normal) >= 0.0;
  return inside && length > 0.0 ? std::min(edges, std::abs(glm::dot(a, normal)) / length) : edges;
}

// Each edge's two vertices and its middle, as numbers of samples.
constexpr std::array<std::array<std::size_t, 3>, 3> c_edges = {{{0, 1, 3}, {0, 2, 4}, {1, 2, 5}}};

Extent extent(const std::array<glm::dvec3, 6>& w) {
  double half_edge = 0.0, sag = 0.0, uneven = 0.0;
  for (const auto& [a, b, middle] : c_edges) {
    half_edge = std::max({half_edge, glm::length(w[middle] - w[a]), glm::length(w[middle] - w[b])});
    const glm::dvec3 off = w[middle] - 0.5 * (w[a] + w[b]), along = w[b] - w[a];
    sag += glm::length(off);
    const double length = glm::length(along);
    if (length > 0.0) uneven = std::max(uneven, std::abs(glm::dot(off, along)) / length);
  }
  // Four flat triangles through the samples; a quadratic field leaves them by a third of an edge's sag at
  // most.
  const double flat =
      std::min({distance_from_origin(w[0], w[3], w[4]), distance_from_origin(w[3], w[1], w[5]),
                distance_from_origin(w[4], w[5], w[2]), distance_from_origin(w[3], w[5], w[4])});
  return {2.0 * half_edge, std::max(0.0, flat - c_sag * sag), uneven};
}

// Beckmann's exp(-tan^2/m^2) falls off as cos^n with n = 2/m^2 near its peak.
double equivalent_exponent(const Material& m) {
  return m.brdf == Brdf::cook_torrance ? std::max(1.0, 2.0 / (m.roughness * m.roughness)) : m.exponent;
}

// The greatest third derivative of exp(-x^2/2), which cos^n is near its peak with x = sqrt(n) angle, at any
// distance from the peak of `x` or more; 1 at the most.
double third_derivative_beyond(double x) {
  constexpr double c_greatest = 1.3801;  // at x^2 = 3 - sqrt(6)
  constexpr double c_second = 0.3753;    // at x^2 = 3 + sqrt(6)
  const double here = (3.0 - x * x) * x * std::exp(-0.5 * x * x);
  if (x * x < 3.0 - std::sqrt(6.0)) return 1.0;
  if (x * x < 3.0 + std::sqrt(6.0)) return std::max(here, c_second) / c_greatest;
  return -here / c_greatest;
}

// The same of the second and the first derivative.
double second_derivative_beyond(double x) {
  return x * x < 3.0 ? 1.0 : (x * x - 1.0) * std::exp(-0.5 * x * x);
}
double first_derivative_beyond(double x) {
  return x < 1.0 ? 1.0 : x * std::exp(0.5 - 0.5 * x * x);
}

// What a quadratic misses of cos^n over a triangle `e` of angles: a part of the side's cube times the third
// derivative of f(w(t)), where an uneven w has the second derivative 8 u and, as a projective map, the third
// 96 u^2/width.
double smooth_miss(const Extent& e, double exponent) {
  const double root = std::sqrt(exponent), s = e.width * root, x = e.least * root, u = e.uneven * root;
  if (s <= 0.0) return 0.0;
  return c_third_derivative *
         (s * s * s * third_derivative_beyond(x) + c_second_derivative * s * u * second_derivative_beyond(x) +
          c_first_derivative * u * u / s * first_derivative_beyond(x));
}

// A bound on the specular factor where the two vectors are at least `angle` apart, `apart` the greatest angle
// between light and eye, `n_dot_v` the least cosine to the eye.
double factor_bound(const Material& m, double angle, double apart, double n_dot_v) {
  const double cosine = std::cos(std::clamp(angle, 0.0, c_pi / 2));
  if (m.brdf != Brdf::cook_torrance) return highlight_power(cosine, m.exponent);
  const double sine = std::sin(std::clamp(angle, 0.0, c_pi / 2));
  // The density falls to its one minimum and may rise again towards the horizon. F grows with the angle
  // between light and halfway vector; the geometry is at most 2/|L+V|^2 and at most 1/(4 N.V).
  const double density =
      std::max(beckmann(cosine, sine * sine, m.roughness), beckmann(0.1, 0.99, m.roughness));
  const double half_cosine = std::cos(std::min(apart, c_pi) / 2.0);
  const double geometry =
      std::min(0.5 / std::max(1e-6, half_cosine * half_cosine), 0.25 / std::max(1e-6, n_dot_v));
  return density * schlick(m.reflectance, half_cosine) * geometry;
}

struct LightOnTriangle {
  std::optional<Cone> to_light;              // none where the light is too near for a cone
  std::array<glm::dvec3, 6> to_light_world;  // unit, at the samples
  glm::dvec3 intensity;
};

struct ViewedTriangle {
  std::optional<Cone> normals, to_eye;
  std::array<glm::dvec3, 6> to_eye_world;  // unit, at the samples
};

// A field of angles whose cones are wider than this is bounded by them alone: six samples may have missed how
// it runs.
constexpr double c_wide = 1.0;

// Reflected light or normal less eye or halfway vector, at the samples: zero at the highlight's peak,
// elsewhere as long as the chord of the angle between them.
std::array<glm::dvec3, 6> off_peak(const Material& m, const SampledTriangle& t, const ViewedTriangle& view,
                                   const LightOnTriangle& light) {
  std::array<glm::dvec3, 6> w;
  for (std::size_t i = 0; i < 6; ++i) {
    const glm::dvec3 &n = t.surface[i].normal_world, &to_light = light.to_light_world[i],
                     &to_eye = view.to_eye_world[i];
    w[i] = m.brdf == Brdf::phong ? 2.0 * glm::dot(n, to_light) * n - to_light - to_eye
                                 : n - glm::normalize(to_light + to_eye);
  }
  return w;
}

// What six samples may miss of the bends in a highlight of 1 at the most: Cook-Torrance's where masking gives
// way to shadowing, the others' where cos^n ends, which shows while n is small.
double missed_bends(const Material& m, const SampledTriangle& t, const ViewedTriangle& view,
                    const LightOnTriangle& light, const std::array<glm::dvec3, 6>& w) {
  Range r;
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

// What one light's highlight may hide between the samples, and what it may amount to, in colour steps.
struct Missed {
  double steps = 0.0, greatest = 0.0;
};
Missed missed_specular(const Material& m, const SampledTriangle& t, const ViewedTriangle& view,
                       const LightOnTriangle& light, bool terminator) {
  const double amplitude = m.specular * largest(m.specular_colour * light.intensity) * c_steps;
  if (amplitude <= 0.0) return {};
  const auto anything = [&] {
    const double greatest = amplitude * factor_bound(m, 0.0, c_pi, 0.0);
    return Missed{greatest, greatest};
  };
  if (!view.normals || !view.to_eye || !light.to_light) return anything();
  const Cone &n = *view.normals, &v = *view.to_eye, &l = *light.to_light;
  const double apart = angle_between(l.axis, v.axis) + l.angle + v.angle;
  const double n_dot_v = std::cos(std::min(c_pi / 2, angle_between(n.axis, v.axis) + n.angle + v.angle));
  double span, between;  // of the cone around w, and of the axes of what w is the difference of
  if (m.brdf == Brdf::phong) {
    span = 2.0 * n.angle + l.angle + v.angle;
    between = angle_between(2.0 * glm::dot(n.axis, l.axis) * n.axis - l.axis, v.axis);
  } else {
    if (apart >= 0.95 * c_pi) return anything();
    // H halves the angle between L and V; a turn of V moves H by 1/(2 cos(half the angle)) as much.
    span = n.angle + (l.angle + v.angle) / (2.0 * std::cos(apart / 2.0));
    between = angle_between(n.axis, glm::normalize(l.axis + v.axis));
  }
  const std::array<glm::dvec3, 6> w = off_peak(m, t, view, light);
  const Extent e = span < c_wide ? extent(w) : Extent{2.0 * span, std::max(0.0, between - span)};
  const double greatest = amplitude * factor_bound(m, e.least, apart, n_dot_v);
  // At the terminator a highlight ends at once, and Cook-Torrance's at the eye's horizon.
  if (terminator || (m.brdf == Brdf::cook_torrance && n_dot_v <= 0.0)) return {greatest, greatest};
  const double smooth =
      amplitude * factor_bound(m, 0.0, apart, n_dot_v) * smooth_miss(e, equivalent_exponent(m));
  const double bends =
      (m.brdf == Brdf::cook_torrance ? greatest : amplitude) * missed_bends(m, t, view, light, w);
  return {std::min(greatest, smooth + bends), greatest};
}

// The same with the diffuse part, of a light that shines on all of the triangle.
Missed missed_light(const Material& m, const SampledTriangle& t, const ViewedTriangle& view,
                    const LightOnTriangle& light) {
  std::array<double, 6> cosine;
  std::array<glm::dvec3, 6> w;
  Range n_dot_l;
  for (std::size_t i = 0; i < 6; ++i) {
    cosine[i] = glm::dot(t.surface[i].normal_world, light.to_light_world[i]);
    n_dot_l.take(cosine[i]);
    w[i] = t.surface[i].normal_world - light.to_light_world[i];
  }
  const double amplitude = m.diffuse * largest(m.colour * light.intensity) * c_steps;
  double diffuse = amplitude;
  if (view.normals && light.to_light) {
    const double between = angle_between(view.normals->axis, light.to_light->axis);
    const double around = view.normals->angle + light.to_light->angle;
    if (between - around > c_pi / 2) return {};  // every normal looks away from the light
    if (around > c_wide) {
      n_dot_l.take(std::cos(std::min(c_pi, between + around)));
      n_dot_l.take(std::cos(std::max(0.0, between - around)));
    }
    const Extent e = extent(w);
    diffuse *= std::min(1.0, c_diffuse / c_third_derivative * smooth_miss({e.width, 0.0, e.uneven}, 1.0));
  }
  // Between the samples N.L may go further: as far as its edges bend, and a little.
  double slack = c_overshoot * n_dot_l.width();
  for (const auto& [a, b, middle] : c_edges)
    slack += c_sag * std::abs(cosine[middle] - 0.5 * (cosine[a] + cosine[b]));
  const double least = n_dot_l.least - slack, most = n_dot_l.most + slack;
  const bool terminator = least < 0.0 && most > 0.0;
  // max(0, N.L) bends there.
  if (terminator) diffuse += amplitude * std::min({most, -least, c_bend * n_dot_l.width()});
  const Missed specular = missed_specular(m, t, view, light, terminator);
  return {diffuse + specular.steps, amplitude * std::max(0.0, n_dot_l.most) + specular.greatest};
}

// What of a spot's cone falls on the triangle: the most of it, and what six samples may miss of its edge.
struct SpotOnTriangle {
  double greatest, missed;
};
SpotOnTriangle spot_on_triangle(const LightCone& spot, const std::optional<Cone>& to_light,
                                const std::array<glm::dvec3, 6>& to_light_world) {
  if (!to_light) return {1.0, 1.0};
  const double off_axis = angle_between(-to_light->axis, spot.axis_world);
  Range angle;
  double width;
  if (to_light->angle < 0.5 * c_wide) {
    std::array<glm::dvec3, 6> w;
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
  // Smoothstep's second derivative jumps by 6 over its width's square where it begins and ends.
  const double outer = std::acos(std::clamp(spot.cos_outer, -1.0, 1.0));
  const double inner = std::acos(std::clamp(spot.cos_inner, -1.0, 1.0));
  const double turn = width / std::max(1e-9, outer - inner);
  return {greatest, std::min(fall, c_spot_edge * turn * turn)};
}

}  // namespace

double centroid_error(const SampledTriangle& t, const glm::dvec3& centroid_radiance) {
  const auto& r = t.radiance;
  const glm::dvec3 quadratic = (4.0 * (r[3] + r[4] + r[5]) - (r[0] + r[1] + r[2])) / 9.0;
  // Both over-exposed look alike.
  return c_steps *
         largest(glm::abs(glm::clamp(quadratic, 0.0, 1.0) - glm::clamp(centroid_radiance, 0.0, 1.0)));
}

double missed_highlight_bound(const Scene& scene, const Material& m, const SampledTriangle& t) {
  const auto directions_to = [&](const glm::dvec3& point_world) {
    std::array<glm::dvec3, 6> d;
    for (std::size_t i = 0; i < 6; ++i) d[i] = direction(t.surface[i].position_world, point_world);
    return d;
  };
  const ViewedTriangle view{
      cone_around({t.surface[0].normal_world, t.surface[1].normal_world, t.surface[2].normal_world}),
      cone_to(t, scene.camera.eye_world), directions_to(scene.camera.eye_world)};
  double missed = 0.0;
  for_each_light(scene, [&](const Light& light) {
    const glm::dvec3& from = light.point.xyz_world;
    LightOnTriangle on_triangle{{}, {}, light.intensity};
    if (light.point.w == 0.0) {
      on_triangle.to_light = Cone{from, 0.0};
      on_triangle.to_light_world.fill(from);
    } else {
      on_triangle.to_light = cone_to(t, from);
      on_triangle.to_light_world = directions_to(from);
    }
    const Missed whole = missed_light(m, t, view, on_triangle);
    if (!light.cone) {
      missed += whole.steps;
      return;
    }
    const SpotOnTriangle spot =
        spot_on_triangle(*light.cone, on_triangle.to_light, on_triangle.to_light_world);
    missed += whole.steps * spot.greatest + whole.greatest * spot.missed;
  });
  return missed;
}

}  // namespace halfway

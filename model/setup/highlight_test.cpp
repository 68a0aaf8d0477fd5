// SPDX-License-Identifier: Apache-2.0
#include "setup/highlight_test.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "reference/shade.hpp"

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

// |third derivative| of cos^n x is at most 1.4 n^1.5, and a quadratic through the ends and the middle of an
// interval h misses by h^3/72 sqrt(3) of it along an edge; a triangle's inside and the curvature of the angle
// itself are covered by the rest of the factor (measured over random triangles: see highlight_test_test.cpp).
double quadratic_miss(double span, double exponent) {
  const double s = span * std::sqrt(exponent);
  return 0.028 * s * s * s;
}

// Beckmann's exp(-tan^2/m^2) falls off as cos^n with n = 2/m^2 near its peak.
double equivalent_exponent(const Material& m) {
  return m.brdf == Brdf::cook_torrance ? std::max(1.0, 2.0 / (m.roughness * m.roughness)) : m.exponent;
}

// A bound on the specular factor where the two vectors are at least `angle` apart.
double factor_bound(const Material& m, double angle) {
  const double cosine = std::cos(std::clamp(angle, 0.0, c_pi / 2));
  if (m.brdf != Brdf::cook_torrance) return highlight_power(cosine, m.exponent);
  const double sine = std::sin(std::clamp(angle, 0.0, c_pi / 2));
  // The density falls from 0 to its one minimum and may rise again towards the horizon; F <= 1, and away from
  // grazing the geometry is at most 1 (toward grazing it grows without bound, and so do the samples).
  return std::max(beckmann(cosine, sine * sine, m.roughness), beckmann(0.1, 0.99, m.roughness));
}

struct LightOnTriangle {
  std::optional<Cone> to_light;
  glm::dvec3 intensity;
};

// What one light's highlight may hide between the samples, in colour steps.
double missed_specular(const Material& m, const Cone& normals, const std::optional<Cone>& eye,
                       const LightOnTriangle& light, double threshold) {
  const double amplitude = m.specular * largest(m.specular_colour * light.intensity) * c_steps;
  if (amplitude <= 0.0) return 0.0;
  double least = 0.0, span = c_pi;
  if (eye && light.to_light) {
    const Cone& l = *light.to_light;
    if (m.brdf == Brdf::phong) {
      const glm::dvec3 reflected = 2.0 * glm::dot(normals.axis, l.axis) * normals.axis - l.axis;
      span = 2.0 * normals.angle + l.angle + eye->angle;
      least = angle_between(reflected, eye->axis) - span;
    } else {
      // H halves the angle between L and V; across it a turn of V moves H by 1/(2 cos(half the angle)) as
      // much.
      const double apart = angle_between(l.axis, eye->axis) + l.angle + eye->angle;
      if (apart < 0.95 * c_pi) {
        const glm::dvec3 halfway = glm::normalize(l.axis + eye->axis);
        span = normals.angle + (l.angle + eye->angle) / (2.0 * std::cos(apart / 2.0));
        least = angle_between(normals.axis, halfway) - span;
      }
    }
    // Every normal looks away from the light: no highlight.
    if (angle_between(normals.axis, l.axis) - normals.angle - l.angle > c_pi / 2) return 0.0;
  }
  const double bound = amplitude * factor_bound(m, std::max(0.0, least));
  if (bound <= threshold) return 0.0;
  const double follows = amplitude * (m.brdf == Brdf::cook_torrance ? factor_bound(m, 0.0) : 1.0) *
                         quadratic_miss(std::min(2.0 * span, c_pi), equivalent_exponent(m));
  if (follows <= threshold) return 0.0;
  return std::min(bound, follows);
}

// What a spot's cone may light between samples that it misses.
double missed_spot(const Material& m, const SpotLight& spot, const SampledTriangle& t,
                   const std::optional<Cone>& to_light) {
  const double amplitude =
      largest(spot.intensity * (m.diffuse * m.colour + m.specular * m.specular_colour)) * c_steps;
  const double outer = std::acos(std::clamp(spot.cos_outer, -1.0, 1.0));
  const double inner = std::acos(std::clamp(spot.cos_inner, -1.0, 1.0));
  if (!to_light) return amplitude;
  const double off_axis = angle_between(-to_light->axis, spot.axis_world);
  if (off_axis - to_light->angle >= outer || off_axis + to_light->angle <= inner) return 0.0;
  double least = 1.0, most = 0.0;
  for (const SurfacePoint& p : t.surface) {
    const glm::dvec3 from_light = glm::normalize(p.position_world - spot.position_world);
    const double f = spot_factor(spot, glm::dot(from_light, spot.axis_world));
    least = std::min(least, f);
    most = std::max(most, f);
  }
  const double possible = spot_factor(spot, std::cos(std::max(0.0, off_axis - to_light->angle)));
  const double darkest = spot_factor(spot, std::cos(std::min(c_pi, off_axis + to_light->angle)));
  // Smoothstep's third derivative is 12 over the cube of its width: wide falls are followed, narrow ones are
  // not.
  const double width = std::max(1e-9, outer - inner);
  const double turn = 2.0 * to_light->angle / width;
  return amplitude *
         std::min(std::max(possible - most, least - darkest) + (most - least), 0.2 * turn * turn * turn);
}

}  // namespace

double centroid_error(const SampledTriangle& t, const glm::dvec3& centroid_radiance) {
  const auto& r = t.radiance;
  const glm::dvec3 quadratic = (4.0 * (r[3] + r[4] + r[5]) - (r[0] + r[1] + r[2])) / 9.0;
  // Both over-exposed look alike.
  return c_steps *
         largest(glm::abs(glm::clamp(quadratic, 0.0, 1.0) - glm::clamp(centroid_radiance, 0.0, 1.0)));
}

double missed_highlight_bound(const Scene& scene, const Material& m, const SampledTriangle& t,
                              double threshold) {
  const std::optional<Cone> normals =
      cone_around({t.surface[0].normal_world, t.surface[1].normal_world, t.surface[2].normal_world});
  const std::optional<Cone> eye = cone_to(t, scene.camera.eye_world);
  double missed = 0.0;
  const auto light = [&](const LightOnTriangle& l) {
    if (normals)
      missed += missed_specular(m, *normals, eye, l, threshold);
    else
      missed += m.specular * largest(m.specular_colour * l.intensity) * c_steps;
  };
  for (const DirectionalLight& d : scene.directional) light({Cone{d.to_light_world, 0.0}, d.intensity});
  for (const PositionalLight& p : scene.positional) light({cone_to(t, p.position_world), p.intensity});
  for (const SpotLight& s : scene.spots) {
    const std::optional<Cone> to_light = cone_to(t, s.position_world);
    const double spot = missed_spot(m, s, t, to_light);
    missed += spot;
    if (to_light && angle_between(-to_light->axis, s.axis_world) - to_light->angle <
                        std::acos(std::clamp(s.cos_outer, -1.0, 1.0)))
      light({to_light, s.intensity});
  }
  return missed;
}

}  // namespace halfway

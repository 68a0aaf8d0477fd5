// SPDX-License-Identifier: Apache-2.0
// A triangle at the six samples of its quadratic, for the tests that decide whether it must be split.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "projection/project.hpp"
#include "scene/lights.hpp"
#include "scene/scene.hpp"
#include "shading/shade.hpp"

namespace halfway {

/// The surface at the three vertices, then at the midpoints of edges 1-2, 1-3, 2-3.
struct SampledTriangle {
  std::array<SurfacePoint, 6> surface;
  std::array<glm::dvec3, 6> radiance;
};

/// A vector for each sample.
using SampleVectors = std::array<glm::dvec3, 6>;

/// The range of some values.
struct ValueRange {
  double least = 1e300, most = -1e300;
  void take(double v) {
    least = std::min(least, v);
    most = std::max(most, v);
  }
  double width() const { return most - least; }
};

inline double largest(const glm::dvec3& v) {
  return std::max({v.x, v.y, v.z});
}

inline SampleVectors directions_to(const SampledTriangle& t, const glm::dvec3& point_world) {
  SampleVectors d;
  for (std::size_t i = 0; i < 6; ++i) d[i] = direction(t.surface[i].position_world, point_world);
  return d;
}
inline SampleVectors directions_to(const SampledTriangle& t, const LightPoint& light) {
  if (light.w != 0.0) return directions_to(t, light.xyz_world);
  SampleVectors d;
  d.fill(light.xyz_world);
  return d;
}

/// Phong: reflected light minus eye. Otherwise: normal minus halfway vector. Zero at the peak of the
/// highlight; elsewhere its length is the chord of the angle between the two vectors.
inline SampleVectors off_peak(const Material& m, const SampledTriangle& t,
                              const SampleVectors& to_light_world, const SampleVectors& to_eye_world) {
  SampleVectors w;
  for (std::size_t i = 0; i < 6; ++i) {
    const glm::dvec3 &n = t.surface[i].normal_world, &to_light = to_light_world[i], &to_eye = to_eye_world[i];
    w[i] = m.brdf == Brdf::phong ? 2.0 * glm::dot(n, to_light) * n - to_light - to_eye
                                 : n - glm::normalize(to_light + to_eye);
  }
  return w;
}

inline constexpr double c_steps = 255.0;  ///< of 1/255, of a colour of 1

/// The greatest diffuse term and the greatest highlight of a light, in colour steps; the highlight for a
/// specular factor of 1.
inline double diffuse_amplitude(const Material& m, const glm::dvec3& intensity) {
  return m.diffuse * largest(m.colour * intensity) * c_steps;
}
inline double specular_amplitude(const Material& m, const glm::dvec3& intensity) {
  return m.specular * largest(m.specular_colour * intensity) * c_steps;
}

/// Distance of the origin from a triangle in space: from its plane if the perpendicular foot lies inside,
/// otherwise from the nearest edge.
double distance_from_origin(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);
/// The same from the nearest of four flat triangles through the samples.
double flat_distance(const SampleVectors& w);

/// An upper bound of the specular factor if the two vectors of the highlight differ by at least `angle`.
/// `apart` is the greatest angle between light and eye, `n_dot_v` the least cosine to the eye.
double factor_bound(const Material& m, double angle, double apart, double n_dot_v);

}  // namespace halfway

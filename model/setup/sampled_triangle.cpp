// SPDX-License-Identifier: Apache-2.0
#include "setup/sampled_triangle.hpp"

#include <cmath>
#include <numbers>

namespace halfway {

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

double flat_distance(const SampleVectors& w) {
  return std::min({distance_from_origin(w[0], w[3], w[4]), distance_from_origin(w[3], w[1], w[5]),
                   distance_from_origin(w[4], w[5], w[2]), distance_from_origin(w[3], w[5], w[4])});
}

double factor_bound(const Material& m, double angle, double apart, double n_dot_v) {
  const double within = std::clamp(angle, 0.0, std::numbers::pi / 2);
  double cosine = std::cos(within);
  if (m.brdf != Brdf::cook_torrance) return highlight_power(cosine, m.exponent);
  double sine = std::sin(within);
  // The density rises up to tan^2 = 2 m^2 - 1 and falls beyond. F increases with the angle between light and
  // halfway vector. The geometry term is at most 2/|L+V|^2 and at most 1/(4 N.V).
  const double peak2 = 1 / (2 * m.roughness * m.roughness);
  if (cosine * cosine > peak2) cosine = std::sqrt(peak2), sine = std::sqrt(1 - peak2);
  const double density = beckmann(cosine, sine * sine, m.roughness);
  const double half_cosine = std::cos(std::min(apart, std::numbers::pi) / 2.0);
  const double geometry =
      std::min(0.5 / std::max(1e-6, half_cosine * half_cosine), 0.25 / std::max(1e-6, n_dot_v));
  return density * schlick(m.reflectance, half_cosine) * geometry;
}

}  // namespace halfway

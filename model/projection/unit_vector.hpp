// SPDX-License-Identifier: Apache-2.0
// Directions of vectors of any length. The largest component is divided out before squaring, so that a vector
// of length 1e-200 has a direction too.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace halfway {

inline double largest_component(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Zero if the vector is zero or not finite.
inline glm::dvec3 unit_or_zero(const glm::dvec3& v) {
  const double largest = largest_component(v);
  return largest > 0.0 && std::isfinite(largest) ? glm::normalize(v / largest) : glm::dvec3(0.0);
}

}  // namespace halfway

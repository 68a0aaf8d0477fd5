// SPDX-License-Identifier: Apache-2.0
// Checks the ranges that scene.hpp gives for a scene's numbers. For scenes that were not read by a loader.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>

#include "common/result.hpp"
#include "scene/scene.hpp"

namespace halfway {

/// Larger numbers would overflow double in squares and products.
inline constexpr double c_max_number = 1e15;

inline bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The error names the first number that is not finite or out of the range given in scene.hpp, the first
/// direction that is not a unit vector, or the first index out of range. A normal may be zero (length at most
/// 1e-8): the triangle's own normal is then used.
Status check_numbers(const Scene& scene);

}  // namespace halfway

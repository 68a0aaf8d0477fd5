// SPDX-License-Identifier: Apache-2.0
// Shadow rays, exactly: which lights reach a point of a surface.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/scene.hpp"
#include "shading/light_ray.hpp"

namespace halfway {

/// What is nearer to a point than this part of the scene's radius does not shadow it: two surfaces there
/// touch.
inline constexpr double c_touching = 1e-9;

/// The scene's triangles in a tree of boxes.
class ShadowRays {
 public:
  /// The scene must outlive it.
  explicit ShadowRays(const Scene& scene);

  /// Does the light reach a point of one of the scene's triangles? Not where the triangle itself is averted
  /// from it, whatever a normal interpolated there says, nor where an averted triangle (light_ray.hpp) lies
  /// on the way.
  bool reaches(LightRef light, const glm::dvec3& point_world, std::uint32_t triangle) const;

  /// Is an averted triangle on the way, more than `least_way` from its start?
  bool is_blocked(const LightRay& ray, double least_way) const;

 private:
  /// A leaf holds order_[first, first + count); without any it has two children, at `first` and behind.
  struct Node {
    glm::dvec3 low_world, high_world;
    std::uint32_t first, count;
  };
  class Builder;

  const Scene* scene_;
  double touching_distance_;
  std::vector<std::uint32_t> order_;  ///< triangles by leaf
  std::vector<Node> nodes_;
};

}  // namespace halfway

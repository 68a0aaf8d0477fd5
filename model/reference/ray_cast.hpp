// SPDX-License-Identifier: Apache-2.0
// Exact shadow rays: which lights reach a point of a surface.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/scene.hpp"
#include "shading/light_ray.hpp"

namespace halfway {

/// Surfaces nearer to a point than this fraction of the scene's radius do not shadow it: they count as
/// touching.
inline constexpr double c_touching = 1e-9;

/// The scene's triangles in a tree of bounding boxes.
class ShadowRays {
 public:
  /// The scene must outlive this object.
  explicit ShadowRays(const Scene& scene);

  /// True if the light reaches a point of one of the scene's triangles, on its outside or its back. False if
  /// this side itself faces away from the light, for any interpolated normal, or if a triangle that faces
  /// away from the light (light_ray.hpp) is between the point and the light.
  bool reaches(LightRef light, const glm::dvec3& point_world, std::uint32_t triangle,
               bool is_back = false) const;

  /// True if a triangle that faces away from the light is on the ray, more than `least_way` from its start.
  bool is_blocked(const LightRay& ray, double least_way) const;

 private:
  /// A leaf contains order_[first, first + count). With count = 0 the node has two children, at `first` and
  /// first + 1.
  struct Node {
    glm::dvec3 low_world, high_world;
    std::uint32_t first, count;
  };
  class Builder;

  const Scene* scene_;
  double touching_distance_;
  std::vector<std::uint32_t> order_;  ///< triangles in the order of the leaves
  std::vector<Node> nodes_;
};

}  // namespace halfway

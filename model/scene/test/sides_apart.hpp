// SPDX-License-Identifier: Apache-2.0
// For tests: a scene whose triangles that are drawn from both sides are two triangles each, front and back.
#pragma once

#include <utility>

#include "scene/mesh.hpp"
#include "scene/scene.hpp"

namespace halfway {

/// Triangle 2 i is the front of triangle i with its normals on the same side, triangle 2 i + 1 its back. Both
/// are culled.
inline Scene sides_apart(const Scene& scene) {
  Scene apart = scene;
  const auto turned = static_cast<std::uint32_t>(scene.normals_world.size());
  for (const glm::dvec3& normal : scene.normals_world) apart.normals_world.push_back(-normal);
  apart.triangles.clear();
  for (SceneTriangle front : scene.triangles) {
    front.culling = Culling::closed;
    SceneTriangle back = front;
    SceneTriangle& against = has_averted_normals(scene, front) ? front : back;
    for (std::uint32_t& normal : against.normal) normal += turned;
    std::swap(back.position[1], back.position[2]);
    std::swap(back.normal[1], back.normal[2]);
    apart.triangles.push_back(front);
    apart.triangles.push_back(back);
  }
  return apart;
}

inline Scene drawn_from_both_sides(Scene scene) {
  for (SceneTriangle& triangle : scene.triangles) triangle.culling = Culling::none;
  return scene;
}

}  // namespace halfway

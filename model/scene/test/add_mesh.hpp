// SPDX-License-Identifier: Apache-2.0
// For tests: adds a mesh to a scene where it is, with the scene's first material.
#pragma once

#include <cstdint>

#include "scene/mesh.hpp"
#include "scene/scene.hpp"

namespace halfway {

inline void add_mesh(Scene& scene, const Mesh& mesh) {
  const auto first_position = static_cast<std::uint32_t>(scene.positions_world.size());
  const auto first_normal = static_cast<std::uint32_t>(scene.normals_world.size());
  scene.positions_world.insert(scene.positions_world.end(), mesh.positions.begin(), mesh.positions.end());
  scene.normals_world.insert(scene.normals_world.end(), mesh.normals.begin(), mesh.normals.end());
  for (SceneTriangle triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      triangle.position[i] += first_position;
      triangle.normal[i] += first_normal;
    }
    triangle.material = 0;
    scene.triangles.push_back(triangle);
  }
}

}  // namespace halfway

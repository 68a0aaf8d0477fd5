// SPDX-License-Identifier: Apache-2.0
// Adds meshes to a scene, and fits a camera to them.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "common/result.hpp"
#include "scene/check_numbers.hpp"
#include "scene/mesh.hpp"
#include "scene/scene.hpp"

namespace halfway {

struct AddOptions {
  double crease_degrees;
  bool replace_normals = false;
  /// Of every triangle. Empty: each triangle keeps its own, but Culling::closed becomes Culling::none where
  /// the surface is not closed.
  std::optional<Culling> culling = {};
};

/// Add a mesh in world space to a scene, with valid normals and materials. `what` is the prefix of messages.
Status add_mesh(Scene& scene, Mesh& mesh, const std::string& what, std::uint32_t first_material,
                const AddOptions& options);

/// Data for fitting a camera after the meshes are added.
struct CameraFit {
  glm::dvec3 to_eye_world{0.4, 0.3, 1.0};
  glm::dvec3 up_world{0.0, 1.0, 0.0};
  double vertical_fov_degrees = 40.0;
  double near = 0.0, far = 0.0;

  Camera camera(const Scene& scene) const;
};

/// A fitted camera fails for a tiny object far from the origin: rounding makes its eye equal to its target.
Status check_view(const Scene& scene, const std::string& what);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
#include "scene_files/add_mesh.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <glm/common.hpp>
#include <vector>

#include "scene/camera.hpp"

namespace halfway {
namespace {

/// Files may contain many positions that no triangle uses.
constexpr std::size_t c_max_positions = 3 * std::size_t{c_max_triangles};

void set_culling(Mesh& mesh, const std::optional<Culling>& wanted) {
  const std::vector<bool> shows = shows_back(mesh);
  for (std::size_t i = 0; i < shows.size(); ++i) {
    Culling& culling = mesh.triangles[i].culling;
    culling = wanted.value_or(culling);
    if (shows[i] && culling == Culling::closed) culling = Culling::none;
    if (!shows[i] && culling == Culling::back) culling = Culling::closed;
  }
}

}  // namespace

Status add_mesh(Scene& scene, Mesh& mesh, const std::string& what, std::uint32_t first_material,
                const AddOptions& options) {
  if (scene.positions_world.size() + mesh.positions.size() > c_max_positions) {
    return bad_input(
        fmt::format("{}: more than {} vertices up to this mesh; use coarser ones", what, c_max_positions));
  }
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::dvec3 size = glm::abs(mesh.positions[i]);
    if (size.x <= c_max_number && size.y <= c_max_number && size.z <= c_max_number) continue;
    return bad_input(fmt::format("{}: vertex {} has a coordinate beyond {:g}; scale the mesh down", what,
                                 i + 1, c_max_number));
  }
  set_culling(mesh, options.culling);  // first, because a triangle without area may close a surface
  const std::size_t dropped = drop_zero_area(mesh);
  if (mesh.triangles.empty()) return bad_input(what + ": no triangle of the mesh has any area");
  if (dropped > 0) {
    scene.notes.push_back(fmt::format("{}: {} triangles without area left out", what, dropped));
  }
  const std::size_t corners = 3 * mesh.triangles.size();
  const std::size_t filled = fill_normals(mesh, options.crease_degrees, options.replace_normals);
  if (!options.replace_normals && filled > 0 && filled < corners) {
    scene.notes.push_back(
        fmt::format("{}: {} of {} corners have no normal; theirs were computed", what, filled, corners));
  }
  const auto first_position = static_cast<std::uint32_t>(scene.positions_world.size());
  const auto first_normal = static_cast<std::uint32_t>(scene.normals_world.size());
  scene.positions_world.insert(scene.positions_world.end(), mesh.positions.begin(), mesh.positions.end());
  // Unused normals may be zero.
  for (const glm::dvec3& normal : mesh.normals) {
    scene.normals_world.push_back(normal == glm::dvec3(0.0) ? glm::dvec3(0.0, 0.0, 1.0) : normal);
  }
  scene.materials.insert(scene.materials.end(), mesh.materials.begin(), mesh.materials.end());
  for (SceneTriangle triangle : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      triangle.position[corner] += first_position;
      triangle.normal[corner] += first_normal;
    }
    triangle.material += first_material;
    scene.triangles.push_back(triangle);
  }
  return Ok{};
}

Camera CameraFit::camera(const Scene& scene) const {
  Camera fitted = fit_camera(bounding_sphere(scene), to_eye_world, up_world, vertical_fov_degrees);
  fitted.near = near;
  fitted.far = far;
  return fitted;
}

Status check_view(const Scene& scene, const std::string& what) {
  if (has_view(scene.camera)) return Ok{};
  return bad_input(
      what +
      ": a camera cannot be fitted, because the scene is too small for its distance from the origin, or "
      "too large; move it to the origin, or scale it");
}

}  // namespace halfway

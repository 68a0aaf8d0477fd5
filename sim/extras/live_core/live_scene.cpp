// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/live_core/live_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <string>
#include <utility>

#include "common/to_integer.hpp"
#include "frame/frame.hpp"
#include "mesh_files/mesh_file.hpp"
#include "scene/camera.hpp"
#include "scene/turntable.hpp"
#include "scene_files/parse_scene.hpp"

namespace halfway::live {
namespace {

constexpr double c_largest_scaled_exponent = 1e15;

bool is_side(double value) {
  return value >= 1.0 && value <= c_max_frame_side && value == std::floor(value);
}

glm::dmat3 rotation(double degrees, const glm::dvec3& axis) {
  return glm::dmat3(glm::rotate(glm::dmat4(1.0), glm::radians(degrees), axis));
}

MeshFile refuse_mesh_file(std::string_view name) {
  return {.path = std::string(name),
          .refusal = "names another file, which cannot be read here; open the mesh itself",
          .mesh = LoadedMesh{}};
}
MaterialLibrary refuse_library(std::string_view name) {
  return {.path = std::string(name), .text = std::nullopt};
}
BufferFile refuse_buffer(std::string_view) {
  return {.refusal = "is another file, which cannot be read here; export a .glb, which has its buffers",
          .bytes = {}};
}

}  // namespace

FrameSize Settings::size() const {
  return {to_integer<std::uint32_t>(width), to_integer<std::uint32_t>(height)};
}

Status check(const Settings& s) {
  if (!is_side(s.width) || !is_side(s.height))
    return bad_input(fmt::format("the frame is {}x{}, but each side must be a whole number from 1 to {}",
                                 s.width, s.height, c_max_frame_side));
  for (const double angle : {s.azimuth, s.elevation, s.light_azimuth, s.light_elevation})
    if (!std::isfinite(angle)) return bad_input("an angle is not finite");
  for (const double factor : {s.distance_factor, s.exponent_factor, s.threshold})
    if (!(factor > 0.0) || !std::isfinite(factor))
      return bad_input("distance, exponent and threshold must be above 0");
  return Ok{};
}

Result<Scene> read_scene(std::string_view file, std::string_view text, double tessellation) {
  if (lower_ending(file) == ".toml")
    return parse_scene(text, file, refuse_mesh_file, {.tessellation = tessellation});
  if (!is_mesh_file_name(file)) return bad_input(fmt::format("{}: {}", file, c_no_scene_file));
  if (tessellation != 1.0)
    return bad_input(std::string(file) + ": a mesh file has the triangles it has: no other tessellation");
  if (text.empty()) return bad_input(std::string(file) + ": the file is empty");
  Result<LoadedMesh> mesh = read_mesh(text, file, {.library = refuse_library, .buffer = refuse_buffer});
  if (!mesh) return mesh.error();
  return scene_of_mesh(std::move(*mesh), file);
}

LiveScene::LiveScene(Scene scene) : scene_(std::move(scene)) {
  own_.camera = scene_.camera;
  own_.directional = scene_.directional;
  own_.positional = scene_.positional;
  own_.spots = scene_.spots;
  own_.materials = scene_.materials;
}

Status LiveScene::apply(const Settings& settings) {
  scene_.camera = orbited(own_.camera, settings.azimuth, settings.elevation, settings.distance_factor);
  if (!has_view(scene_.camera))
    return bad_input(scene_.name + ": no view: the camera's eye is too near its target; move it away");
  scene_.materials = own_.materials;
  if (settings.exponent_factor != 1.0)
    for (Material& material : scene_.materials)
      material.exponent =
          std::clamp(settings.exponent_factor * material.exponent, 1.0, c_largest_scaled_exponent);
  turn_lights(settings);
  return Ok{};
}

void LiveScene::turn_lights(const Settings& settings) {
  scene_.directional = own_.directional;
  scene_.positional = own_.positional;
  scene_.spots = own_.spots;
  if (settings.light_azimuth == 0.0 && settings.light_elevation == 0.0) return;
  const Camera& camera = own_.camera;
  const glm::dmat3 turn = rotation(-settings.light_elevation, view_basis(camera).right_world) *
                          rotation(settings.light_azimuth, glm::normalize(camera.up_world));
  const auto around_target = [&](const glm::dvec3& position) {
    return camera.target_world + turn * (position - camera.target_world);
  };
  for (DirectionalLight& light : scene_.directional)
    light.to_light_world = glm::normalize(turn * light.to_light_world);
  for (PositionalLight& light : scene_.positional) light.position_world = around_target(light.position_world);
  for (SpotLight& light : scene_.spots) {
    light.position_world = around_target(light.position_world);
    light.axis_world = glm::normalize(turn * light.axis_world);
  }
}

}  // namespace halfway::live

// SPDX-License-Identifier: Apache-2.0
// Scenes of the C interface.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <utility>

#include "mesh_files/loaded_mesh.hpp"
#include "scene/camera.hpp"
#include "scene/check_numbers.hpp"
#include "scene/lights.hpp"
#include "scene/turntable.hpp"
#include "scene_files/parse_scene.hpp"
#include "sim/extras/library/objects.hpp"
#include "sim/files/load_scene.hpp"

namespace halfway::library {
namespace {

constexpr double c_default_fov_degrees = 40.0;

glm::dvec3 vector(const double* numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

Result<halfway_scene> with_camera(Result<Scene> scene) {
  if (!scene) return scene.error();
  const Camera camera = scene->camera;
  return halfway_scene{std::move(*scene), camera};
}

MeshFile refuse_mesh_file(std::string_view name) {
  return {.path = std::string(name),
          .refusal = "names another file; load the scene from its file instead of its text",
          .mesh = LoadedMesh{}};
}

/// Copy the arrays of a mesh. Normals of length 0 are computed later.
Result<LoadedMesh> mesh_of_arrays(const halfway_mesh& arrays) {
  if (!arrays.positions) return bad_input("mesh: positions is null");
  if (arrays.vertices > c_max_vertices || arrays.triangles > c_max_triangles)
    return bad_input(fmt::format("mesh: {} vertices and {} triangles, but at most {} and {} are possible",
                                 arrays.vertices, arrays.triangles, c_max_vertices, c_max_triangles));
  if (!arrays.corners && arrays.vertices < 3 * arrays.triangles)
    return bad_input(fmt::format("mesh: {} vertices for {} triangles; give corners, or three each",
                                 arrays.vertices, arrays.triangles));
  LoadedMesh loaded;
  Mesh& mesh = loaded.mesh;
  mesh.materials = {default_material()};
  if (arrays.colour) mesh.materials[0].colour = vector(arrays.colour);
  for (std::size_t i = 0; i < arrays.vertices; ++i) {
    mesh.positions.push_back(vector(arrays.positions + 3 * i));
    const glm::dvec3 normal = arrays.normals ? vector(arrays.normals + 3 * i) : glm::dvec3(0.0);
    const double length = glm::length(normal);
    if (!is_finite(mesh.positions.back()) || !std::isfinite(length))
      return bad_input(fmt::format("mesh: vertex {} has a number that is not finite", i));
    mesh.normals.push_back(length > 0.0 ? normal / length : glm::dvec3(0.0));
  }
  for (std::size_t i = 0; i < arrays.triangles; ++i) {
    SceneTriangle triangle{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t at = 3 * i + corner;
      const std::size_t vertex = arrays.corners ? arrays.corners[at] : at;
      if (vertex >= arrays.vertices)
        return bad_input(fmt::format("mesh: triangle {} has vertex {} of {}", i, vertex, arrays.vertices));
      triangle.position[corner] = triangle.normal[corner] = static_cast<std::uint32_t>(vertex);
    }
    mesh.triangles.push_back(triangle);
  }
  join_positions(mesh);
  return loaded;
}

Status set_camera(halfway_scene& scene, const Camera& camera) {
  for (const glm::dvec3& v : {camera.eye_world, camera.target_world, camera.up_world})
    if (!is_finite(v)) return bad_input("camera: a number is not finite");
  if (!has_view(camera))
    return bad_input("camera: no view: eye and target are equal, or up points along the view");
  scene.scene.camera = camera;
  return Ok{};
}

}  // namespace
}  // namespace halfway::library

using namespace halfway;
using namespace halfway::library;

halfway_scene* halfway_load_scene(const char* name, const char* scenes_folder, halfway_error* error) {
  return made<halfway_scene>(error, [&]() -> Result<halfway_scene> {
    if (!name) return bad_input("the scene has no name; give a built-in name or a file");
    return with_camera(load_scene(name, scenes_folder ? scenes_folder : ""));
  });
}

halfway_scene* halfway_parse_scene(const char* toml, const char* name, halfway_error* error) {
  return made<halfway_scene>(error, [&]() -> Result<halfway_scene> {
    if (!toml) return bad_input("the scene has no text");
    return with_camera(parse_scene(toml, name ? name : "scene", refuse_mesh_file));
  });
}

halfway_scene* halfway_make_scene(const halfway_mesh* mesh, halfway_error* error) {
  return made<halfway_scene>(error, [&]() -> Result<halfway_scene> {
    if (!mesh) return bad_input("mesh: is null");
    Result<LoadedMesh> loaded = mesh_of_arrays(*mesh);
    if (!loaded) return loaded.error();
    Result<halfway_scene> scene = with_camera(scene_of_mesh(std::move(*loaded), "mesh"));
    if (!scene) return scene;
    if (Status status = check_numbers(scene->scene); !status) return status.error();
    return scene;
  });
}

int halfway_set_camera(halfway_scene* scene, const halfway_camera* camera, halfway_error* error) {
  return done(error, [&]() -> Status {
    const double fov =
        camera->vertical_fov_degrees == 0.0 ? c_default_fov_degrees : camera->vertical_fov_degrees;
    if (!(fov > 0.0 && fov < 180.0))
      return bad_input(fmt::format("camera: vertical_fov_degrees is {}; give 0 to 180", fov));
    const Status status = set_camera(*scene, {.eye_world = vector(camera->eye),
                                              .target_world = vector(camera->target),
                                              .up_world = vector(camera->up),
                                              .vertical_fov_degrees = fov});
    if (status) scene->own_camera = scene->scene.camera;
    return status;
  });
}

int halfway_orbit_camera(halfway_scene* scene, double azimuth_degrees, double elevation_degrees,
                         double distance_factor, halfway_error* error) {
  return done(error, [&]() -> Status {
    if (!std::isfinite(azimuth_degrees) || !std::isfinite(elevation_degrees))
      return bad_input("camera: an angle is not finite");
    if (!(distance_factor > 0.0) || !std::isfinite(distance_factor))
      return bad_input(fmt::format("camera: distance_factor is {}; give a number above 0", distance_factor));
    return set_camera(*scene,
                      orbited(scene->own_camera, azimuth_degrees, elevation_degrees, distance_factor));
  });
}

int halfway_set_lights(halfway_scene* scene, const halfway_light* lights, size_t count,
                       halfway_error* error) {
  return done(error, [&]() -> Status {
    std::vector<DirectionalLight> directional;
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dvec3 to_light = vector(lights[i].to_light), intensity = vector(lights[i].intensity);
      const double length = glm::length(to_light);
      if (!(length > 0.0) || !std::isfinite(length))
        return bad_input(fmt::format("light {}: to_light has the length {}", i, length));
      if (!is_finite(intensity) || intensity.x < 0.0 || intensity.y < 0.0 || intensity.z < 0.0)
        return bad_input(fmt::format("light {}: an intensity is not a number from 0 on", i));
      directional.push_back({.to_light_world = to_light / length, .intensity = intensity});
    }
    clear_lights(scene->scene);
    scene->scene.directional = std::move(directional);
    return Ok{};
  });
}

size_t halfway_triangle_count(const halfway_scene* scene) {
  return scene->scene.triangles.size();
}

void halfway_free_scene(halfway_scene* scene) {
  delete scene;
}

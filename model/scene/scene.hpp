// SPDX-License-Identifier: Apache-2.0
// A scene: camera, lights, materials and triangles. World space, linear radiance, double.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace halfway {

enum class Brdf { blinn, phong, cook_torrance };

/// Reflection of one surface. The ambient and the diffuse terms use `colour`, the specular term uses
/// `specular_colour`.
struct Material {
  std::string name;
  Brdf brdf = Brdf::blinn;
  glm::dvec3 colour{1.0};
  glm::dvec3 specular_colour{1.0};
  glm::dvec3 emission{0.0};   ///< radiance that the surface adds by itself; drawn with the ambient term
  double ambient = 0.1;       ///< k_a >= 0
  double diffuse = 0.6;       ///< k_d >= 0
  double specular = 0.4;      ///< k_s >= 0
  double exponent = 20.0;     ///< n >= 1: Blinn's (N.H)^n, Phong's (R.V)^n
  double roughness = 0.3;     ///< m in (0, 1], Beckmann slope of Cook-Torrance
  double reflectance = 0.05;  ///< F at normal incidence in [0, 1], Cook-Torrance (Schlick's Fresnel term)
};

struct DirectionalLight {
  glm::dvec3 to_light_world{0.0, 0.0, 1.0};  ///< unit
  glm::dvec3 intensity{1.0};
};

struct PositionalLight {
  glm::dvec3 position_world{0.0};
  glm::dvec3 intensity{1.0};  ///< without attenuation by distance, as in the processors paper
};

/// Full inside `cos_inner`, zero outside `cos_outer`, smoothstep in the cosine between.
struct SpotLight {
  glm::dvec3 position_world{0.0};
  glm::dvec3 axis_world{0.0, 0.0, -1.0};  ///< unit, the direction in which the light points
  double cos_inner = 0.9;
  double cos_outer = 0.8;  ///< <= cos_inner
  glm::dvec3 intensity{1.0};
};

/// What is drawn of a triangle that shows its back to the eye.
enum class Culling : std::uint32_t {
  closed,  ///< nothing: it is part of a closed surface, which hides it
  back,    ///< nothing, although it may be in view
  none,    ///< its back, with the normals turned to the eye
};

/// One triangle; indices into Scene::positions_world, ::normals_world and ::materials.
/// Counter-clockwise seen from outside.
struct SceneTriangle {
  std::array<std::uint32_t, 3> position;
  std::array<std::uint32_t, 3> normal;
  std::uint32_t material;
  Culling culling = Culling::closed;
};

struct Camera {
  glm::dvec3 eye_world{0.0, 0.0, 5.0};
  glm::dvec3 target_world{0.0};
  glm::dvec3 up_world{0.0, 1.0, 0.0};
  double vertical_fov_degrees = 40.0;
  double near = 0.0;  ///< 0: fitted to the scene
  double far = 0.0;   ///< 0: fitted to the scene
};

struct Scene {
  std::string name;  ///< of the file, without folder and extension; also names the output folder
  Camera camera;
  glm::dvec3 ambient{0.2};     ///< I_a
  glm::dvec3 background{0.0};  ///< of pixels that no triangle covers
  bool shadows = false;        ///< true: surfaces cast shadows
  std::vector<DirectionalLight> directional;
  std::vector<PositionalLight> positional;
  std::vector<SpotLight> spots;
  std::vector<Material> materials;
  std::vector<glm::dvec3> positions_world;
  std::vector<glm::dvec3> normals_world;  ///< unit
  std::vector<SceneTriangle> triangles;
  std::vector<std::string> notes;  ///< what the loader corrected or omitted, one sentence each; no errors
};

inline constexpr std::uint32_t c_max_triangles = 10'000'000;

}  // namespace halfway

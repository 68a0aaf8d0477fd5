// SPDX-License-Identifier: Apache-2.0
// The lights of a scene, of every kind, through one interface: where the light comes from, how bright it is,
// and which share of it a cone lets through. Everything that walks over lights does it through this header.
#pragma once

#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace halfway {

/// A new kind needs a list in Scene, an enumerator here, and a case in each switch that the compiler then
/// names (-Werror=switch): a shader either draws the kind or refuses it.
enum class LightKind { directional, positional, spot };
inline constexpr std::array c_light_kinds = {LightKind::directional, LightKind::positional, LightKind::spot};

/// Such as "positional".
const char* to_string(LightKind kind);

/// Names a light of a scene.
struct LightRef {
  LightKind kind;
  std::size_t index;  ///< into the scene's list of that kind
  friend bool operator==(const LightRef&, const LightRef&) = default;
};

/// Such as "positional light 2".
std::string name_of(LightRef light);

/// Where light comes from, in homogeneous coordinates.
struct LightPoint {
  glm::dvec3 xyz_world;  ///< a unit direction where w = 0
  double w;              ///< 0 for a directional light, 1 for one with a position

  /// Towards the light: as far as it is, or unit.
  glm::dvec3 way_from(const glm::dvec3& point_world) const { return xyz_world - w * point_world; }
};

/// The cone of a spot: full inside `cos_inner`, nothing outside `cos_outer`, smoothstep between.
struct LightCone {
  glm::dvec3 axis_world;  ///< unit, the direction in which the light points
  double cos_inner, cos_outer;
};

/// One light, whatever its kind.
struct Light {
  LightRef ref;
  LightPoint point;
  glm::dvec3 intensity;
  std::optional<LightCone> cone;  ///< none: the light shines in every direction
};

/// Unit vector from one point to another, zero where they coincide.
glm::dvec3 direction(glm::dvec3 from, glm::dvec3 to);

/// Unit vector from a point to the light; zero where the light is at the very point.
glm::dvec3 direction_to(const Light& light, const glm::dvec3& point_world);

/// Smoothstep from 0 at cos_outer to 1 at cos_inner; a step where they are equal.
double cone_share(const LightCone& cone, double cos_to_axis);
/// The share of the light that leaves in the direction opposite to `to_light` (unit): 1 without a cone.
double cone_share(const Light& light, const glm::dvec3& to_light);

std::size_t light_count(const Scene& scene, LightKind kind);
std::size_t light_count(const Scene& scene);
Light light_of(const Scene& scene, LightRef ref);

/// Calls visit(Light) for every light: kind by kind in the order of c_light_kinds, each in the scene's order.
template <class Visit>
void for_each_light(const Scene& scene, Visit&& visit) {
  for (const LightKind kind : c_light_kinds)
    for (std::size_t i = 0; i < light_count(scene, kind); ++i) visit(light_of(scene, {kind, i}));
}

}  // namespace halfway

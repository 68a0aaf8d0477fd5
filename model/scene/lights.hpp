// SPDX-License-Identifier: Apache-2.0
// One interface to the lights of a scene, of every kind: position or direction, intensity and cone. All code
// that iterates over lights uses this header.
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
/// names (-Werror=switch), such as its equation in shading/shade.hpp. A shader either draws the kind or
/// refuses it. Not all places are switches: docs/extending.md lists them.
enum class LightKind { directional, positional, spot };
inline constexpr std::array c_light_kinds = {LightKind::directional, LightKind::positional, LightKind::spot};

/// For example "positional".
const char* to_string(LightKind kind);

/// What a light of this kind adds to its diffuse term. It decides which effects a scene needs.
bool has_highlight(LightKind kind);
bool casts_shadow(LightKind kind);

/// Identifies one light of a scene.
struct LightRef {
  LightKind kind;
  std::size_t index;  ///< in the scene's list of that kind
  friend bool operator==(const LightRef&, const LightRef&) = default;
};

/// For example "positional light 2".
std::string name_of(LightRef light);

/// Position or direction of a light, in homogeneous coordinates.
struct LightPoint {
  glm::dvec3 xyz_world;  ///< a unit direction if w = 0
  double w;              ///< 0 for a directional light, 1 for a light with a position

  /// Vector towards the light: of the distance's length if the light has a position, otherwise unit.
  glm::dvec3 way_from(const glm::dvec3& point_world) const { return xyz_world - w * point_world; }
};

/// The cone of a spot: full inside `cos_inner`, zero outside `cos_outer`, smoothstep between.
struct LightCone {
  glm::dvec3 axis_world;  ///< unit, the direction in which the light points
  double cos_inner, cos_outer;
};

/// One light of any kind.
struct Light {
  LightRef ref;
  LightPoint point;
  glm::dvec3 intensity;
  std::optional<LightCone> cone;  ///< empty: the light shines in every direction
};

/// Unit vector from one point to another, zero if they coincide.
glm::dvec3 direction(glm::dvec3 from, glm::dvec3 to);

/// Unit vector from a point to the light, zero if the light is at the point.
glm::dvec3 direction_to(const Light& light, const glm::dvec3& point_world);

/// Smoothstep from 0 at cos_outer to 1 at cos_inner. A step if they are equal.
double cone_share(const LightCone& cone, double cos_to_axis);
/// The share of the light emitted in the direction opposite to `to_light` (unit). 1 if the light has no cone.
double cone_share(const Light& light, const glm::dvec3& to_light);

std::size_t light_count(const Scene& scene, LightKind kind);
std::size_t light_count(const Scene& scene);
Light light_of(const Scene& scene, LightRef ref);
/// Removes the lights of every kind. The ambient light remains.
void clear_lights(Scene& scene);

/// Every light, in the order of for_each_light.
std::vector<Light> lights_of(const Scene& scene);

/// Calls visit(Light) for every light: by kind in the order of c_light_kinds, within a kind in the scene's
/// order.
template <class Visit>
void for_each_light(const Scene& scene, Visit&& visit) {
  for (const LightKind kind : c_light_kinds)
    for (std::size_t i = 0; i < light_count(scene, kind); ++i) visit(light_of(scene, {kind, i}));
}

}  // namespace halfway

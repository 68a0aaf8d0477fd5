// SPDX-License-Identifier: Apache-2.0
// The way from a point to a light, and the triangles on it.
//
// Who casts a shadow: a triangle that turns its outside away from the light. A ray from outside a closed mesh
// crosses as many of these as of the others, so the shadow is the whole mesh's; and no surface that faces the
// light lies on a caster of its own mesh, so none can shadow itself by rounding.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "scene/lights.hpp"
#include "scene/scene.hpp"

namespace halfway {

using CornersWorld = std::array<glm::dvec3, 3>;

inline CornersWorld corners_world(const Scene& scene, const SceneTriangle& triangle) {
  return {scene.positions_world[triangle.position[0]], scene.positions_world[triangle.position[1]],
          scene.positions_world[triangle.position[2]]};
}

/// Does the triangle turn its outside away from the light? One that is edge-on does not.
bool is_averted(const CornersWorld& corners_world, const LightPoint& light);

enum class Crossing {
  none,
  enters,  ///< through the outside, into the mesh: the triangle is averted from the light
  leaves,  ///< through the inside, out of the mesh
};

/// A ray from a point to a light. Watertight: where triangles meet in an edge or a vertex, rays through it
/// cross just as those beside it do.
class LightRay {
 public:
  /// The point is not the light's place.
  LightRay(const glm::dvec3& from_world, const LightPoint& light);

  struct Hit {
    Crossing crossing = Crossing::none;
    double way = 0.0;  ///< in parts of the way to the light; lengths where the light is directional
  };
  /// Only between the point and the light, more than `least_way` from the point.
  Hit hit(const CornersWorld& corners_world, double least_way = 0.0) const;

  const glm::dvec3& from_world() const { return from_world_; }
  const glm::dvec3& direction_world() const { return direction_world_; }
  /// Of the light; infinite for a directional one.
  double greatest_way() const { return greatest_way_; }

 private:
  glm::dvec3 from_world_, direction_world_;
  double greatest_way_;
  int x_, y_, z_;  ///< axes; z is where the direction is longest
  double shear_x_, shear_y_, scale_z_;
};

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// The ray from a point to a light, and the triangles that it meets.
//
// A triangle casts a shadow if its outside faces away from the light. A ray from outside a closed mesh
// crosses as many of these triangles as of the others, so together they cast the shadow of the whole mesh. A
// surface that faces the light lies on no shadow caster of its own mesh, so rounding cannot make it shadow
// itself.
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

/// True if the outside of the triangle faces away from the light. False for a triangle seen edge-on.
bool is_averted(const CornersWorld& corners_world, const LightPoint& light);

enum class Crossing {
  none,
  enters,  ///< through the outside, into the mesh: the triangle faces away from the light
  leaves,  ///< through the inside, out of the mesh
};

/// A ray from a point to a light. Watertight: where triangles meet in an edge or a vertex, a ray through it
/// crosses as many triangles as a ray next to it.
class LightRay {
 public:
  /// The point must not be at the light.
  LightRay(const glm::dvec3& from_world, const LightPoint& light);

  struct Hit {
    Crossing crossing = Crossing::none;
    double way = 0.0;  ///< as a fraction of the distance to the light; a length if the light is directional
  };
  /// Counts crossings only between the point and the light, and more than `least_way` from the point.
  Hit hit(const CornersWorld& corners_world, double least_way = 0.0) const;

  const glm::dvec3& from_world() const { return from_world_; }
  const glm::dvec3& direction_world() const { return direction_world_; }
  /// Position of the light on the ray; infinite for a directional light.
  double greatest_way() const { return greatest_way_; }

 private:
  glm::dvec3 from_world_, direction_world_;
  double greatest_way_;
  int x_, y_, z_;  ///< axes; z is the axis of the direction's largest component
  double shear_x_, shear_y_, scale_z_;
};

}  // namespace halfway

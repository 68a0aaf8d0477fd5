// SPDX-License-Identifier: Apache-2.0
// Shadow polygons: the surfaces of the volumes in the shadow of a light, for shaders that count them.
//
// For one light, every triangle that faces away from it (light_ray.hpp) is extruded away from the light to
// beyond the scene and the eye. Together these volumes have a closed surface: the triangles themselves in
// reversed orientation (near cap), sides along the silhouette, where these triangles meet others, and the
// images of the triangles at the far end (far cap). The number of volumes around a point equals the number of
// triangles facing away from the light between the point and the light. The point is in shadow if this number
// is not zero. This holds for any mesh, because every set of triangles has a boundary: open edges, edges of
// more than two triangles and nested volumes are no special cases.
//
// The counting rule. A pixel starts with the number of volumes around the eye. Each polygon strictly nearer
// than the visible surface (depth <) adds one if it opens a volume (faces the eye), and subtracts one if it
// closes a volume. The light reaches the surface if the result is zero. Polygons to draw:
//
//  - Sides. At equal depth they do not count: there they only start, on the silhouette of their own
//    caster.
//  - The part of the sides in front of the near plane, at depth 0, because the count starts at the eye. The
//    part nearer than c_least_near of the near distance is omitted: it matters only if the eye almost touches
//    a side.
//  - Near caps, only in rare cases. A cap that faces the eye lies on a drawn triangle, so no visible surface
//    is behind it. The inside of a mesh is visible only if the mesh is open, if the eye is in the mesh, or if
//    the near plane cuts it open. Only then such caps are drawn.
//  - Far caps, never: eye and scene are in front of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "projection/project.hpp"
#include "shading/light_ray.hpp"

namespace halfway {

/// Data common to all volumes of one light.
struct ShadowVolumes {
  LightRef light;
  std::vector<std::uint32_t> averted;  ///< the triangles of the scene that cast shadows
  std::vector<CornersWorld> sides;     ///< counter-clockwise seen from outside the volumes
  /// Length of the extrusion. For a positional light it is the ratio of the distances from the light.
  double extent;
  std::uint32_t around_eye;  ///< number of volumes around the eye
};

/// Greatest ratio of distances for the volumes of a positional light, even if the scene extends farther, so
/// that coordinates stay in the range of the projection. It limits volumes of a caster at a distance of a
/// millionth of the scene's size from the light.
inline constexpr double c_largest_extent = 1e6;

/// One entry per light, in the given order: usually that of shining_lights.
std::vector<ShadowVolumes> make_shadow_volumes(const Scene& scene, std::span<const LightRef> lights);

/// The complete surface of the volumes, including both caps.
std::vector<CornersWorld> closed_surface(const Scene& scene, const ShadowVolumes& volumes);

/// A piece of this surface on the screen, to be drawn.
struct ShadowPolygon {
  ScreenTriangle triangle;  ///< `source`: the polygon's number in its light; `material` 0; no normals
  std::uint32_t light;      ///< index of its volumes
  bool opens;               ///< true: the ray from the eye enters a volume here; false: it leaves one
};

/// All polygons that the counting rule above needs, light by light. `counts` counts pieces. The caller must
/// check it for unrepresentable ones.
std::vector<ShadowPolygon> shadow_polygons(const Scene& scene, const Projector& projector,
                                           std::span<const ShadowVolumes> volumes, ProjectionCounts& counts);

}  // namespace halfway

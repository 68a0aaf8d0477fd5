// SPDX-License-Identifier: Apache-2.0
// Shadow polygons: the surfaces of the volumes that a light's casters keep dark, for shaders that count them.
//
// For one light, every averted triangle (light_ray.hpp) is drawn out away from the light to beyond the scene
// and the eye. Together these volumes have a closed surface: the averted triangles themselves, turned round
// (near cap), sides from the silhouette, where averted triangles meet others, and the triangles' images at
// the far end (far cap). A point lies in as many volumes as there are averted triangles on its way to the
// light; it is in shadow where that is not zero. This holds for any mesh, as a chain of triangles has a
// boundary: open edges, edges of more than two triangles and volumes within volumes need no case of their
// own.
//
// The rule of counting. A pixel starts with the number of volumes around the eye. Each polygon strictly
// nearer than the visible surface (depth <) adds one where it opens, that is, faces the eye, and takes one
// off where it closes. At zero the light reaches the surface. What that takes:
//  - Sides. At equal depth they do not count: there they only begin, on the caster's own silhouette.
//  - The part of them before the near plane too, at depth 0: the count starts at the eye. Only what is
//    nearer than c_least_near of the near distance is lost, to an eye that all but touches a side.
//  - Near caps hardly ever. One that faces the eye lies on a triangle that is drawn, so no visible surface is
//    behind it; and seen from inside its mesh it only shows through an open mesh, where the eye is in the
//    mesh, or where the near plane cuts it open. Only then such caps are drawn.
//  - Far caps never: eye and scene lie before them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "setup/project.hpp"
#include "shading/light_ray.hpp"

namespace halfway {

/// What one light's volumes share.
struct ShadowVolumes {
  LightRef light;
  std::vector<std::uint32_t> averted;  ///< the scene's triangles that cast
  std::vector<CornersWorld> sides;     ///< counter-clockwise seen from outside the volumes
  double extent;  ///< how far they are drawn out: a length, or for a light with a place the ratio of
                  ///< distances from it
  std::uint32_t around_eye;  ///< volumes that the eye is in
};

/// A positional light's volumes end after this ratio of distances even where the scene goes on, so that
/// coordinates stay fit for projection: behind a caster a millionth of the scene's size from the light.
inline constexpr double c_largest_extent = 1e6;

/// One entry for each light, in the order given: usually that of shining_lights.
std::vector<ShadowVolumes> make_shadow_volumes(const Scene& scene, std::span<const LightRef> lights);

/// All of the volumes' surface, both caps included.
std::vector<CornersWorld> closed_surface(const Scene& scene, const ShadowVolumes& volumes);

/// A piece of it on the screen, as it is to be drawn.
struct ShadowPolygon {
  ScreenTriangle triangle;  ///< `source` numbers the polygon among its light's; `material` is 0; no normals
  std::uint32_t light;      ///< index of its volumes
  bool opens;               ///< the way from the eye enters a volume there; else it leaves one
};

/// Everything that the rule of counting above needs, light by light. `counts` is of pieces; a caller checks
/// it for unrepresentable ones.
std::vector<ShadowPolygon> shadow_polygons(const Scene& scene, const Projector& projector,
                                           std::span<const ShadowVolumes> volumes, ProjectionCounts& counts);

}  // namespace halfway

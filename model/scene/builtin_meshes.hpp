// SPDX-License-Identifier: Apache-2.0
// Built-in meshes. They need no file.
#pragma once

#include <cstdint>

#include "scene/mesh.hpp"

namespace halfway {

/// 2 slices (stacks - 1) triangles.
constexpr std::uint64_t uv_sphere_triangles(std::uint64_t slices, std::uint64_t stacks) {
  return 2 * slices * (stacks - 1);
}

/// A closed sphere around the origin, poles on the y axis, with the exact normals of the sphere. 12 x 8, 17 x
/// 12 and 23 x 16 give the spheres of 168, 374 and 690 triangles in figures 9 to 11 of the quadratic paper.
/// `slices` >= 3, `stacks` >= 2, `radius` > 0.
Mesh make_uv_sphere(std::uint32_t slices, std::uint32_t stacks, double radius);

/// 64 g^2 - 8 g: 32 patches of 2 g^2 triangles, minus the triangles of zero area at the two poles.
constexpr std::uint64_t teapot_triangles(std::uint64_t divisions) {
  return 64 * divisions * divisions - 8 * divisions;
}

/// Newell's teapot of 32 bicubic Bezier patches, bottom included, with the exact normals of the surface. Each
/// patch is divided into `divisions` >= 2 parts along both parameters. y up, spout towards +x, the bottom on
/// y = 0, 3.15 high.
///
/// Four pieces: pot, lid, handle and spout. As in Newell's data each piece is open at its rims (pot and lid
/// have one rim, handle and spout two) and watertight elsewhere: adjacent patches share bit-identical
/// vertices. (With one division handle and spout would be flat.)
Mesh make_teapot(std::uint32_t divisions);

/// 12 d^2.
constexpr std::uint64_t box_triangles(std::uint64_t divisions) {
  return 12 * divisions * divisions;
}

/// A closed box around the origin, flat on each face, with `divisions` >= 1 squares along every edge. `size`
/// > 0: its lengths along x, y and z.
Mesh make_box(const glm::dvec3& size, std::uint32_t divisions);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// Meshes that need no file.
#pragma once

#include <cstdint>

#include "scene/mesh.hpp"

namespace halfway {

/// 2 slices (stacks - 1) triangles.
constexpr std::uint64_t uv_sphere_triangles(std::uint64_t slices, std::uint64_t stacks) {
  return 2 * slices * (stacks - 1);
}

/// A sphere around the origin, poles on the y axis, closed, with the sphere's own normals.
/// 12 x 8, 17 x 12 and 23 x 16 are the spheres of 168, 374 and 690 triangles in the quadratic paper's figures
/// 9 to 11. `slices` >= 3, `stacks` >= 2, `radius` > 0.
Mesh make_uv_sphere(std::uint32_t slices, std::uint32_t stacks, double radius);

/// 64 g^2 - 8 g: 32 patches of 2 g^2, less the triangles that vanish at the two poles.
constexpr std::uint64_t teapot_triangles(std::uint64_t divisions) {
  return 64 * divisions * divisions - 8 * divisions;
}

/// Newell's teapot of 32 bicubic Bezier patches, bottom included, each cut in `divisions` >= 2 parts along
/// both parameters, with the surface's own normals. y up, spout towards +x, standing on y = 0, 3.15 high.
///
/// Four pieces: the pot, the lid, the handle, the spout. As in the data each is open at its rims (pot and lid
/// one, handle and spout two) and watertight elsewhere: patches that meet share their vertices bit for bit.
/// (One division would press handle and spout flat.)
Mesh make_teapot(std::uint32_t divisions);

/// 12 d^2.
constexpr std::uint64_t box_triangles(std::uint64_t divisions) {
  return 12 * divisions * divisions;
}

/// A box around the origin, closed, flat on each face, with `divisions` >= 1 squares along every edge.
/// `size` > 0: its lengths along x, y and z.
Mesh make_box(const glm::dvec3& size, std::uint32_t divisions);

}  // namespace halfway

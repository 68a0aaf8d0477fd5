// SPDX-License-Identifier: Apache-2.0
// A mesh before it becomes part of a scene, and the operations that every mesh needs: join vertices, remove
// triangles of zero area, compute normals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/scene.hpp"

namespace halfway {

/// As in Scene, but in the mesh's own space until `transform` moves it to world space. A zero normal means
/// "missing": `fill_normals` computes it.
struct Mesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;
  std::vector<SceneTriangle> triangles;
  std::vector<Material> materials;
};

/// Gives vertices with equal coordinates the same index, so that adjacent triangles share indices.
void join_positions(Mesh& mesh);

/// Transforms the mesh by an invertible affine matrix. Normals are transformed by the inverse transpose. For
/// a mirroring matrix the order of the corners is reversed, so that the outside stays outside.
void transform(Mesh& mesh, const glm::dmat4& matrix);

/// Removes triangles whose height is below rounding (1e-12 of their longest edge). Returns their number.
std::size_t drop_zero_area(Mesh& mesh);

/// Computes normals for every corner whose normal is missing, or for all corners with `replace_all`. Returns
/// the number of corners with a new normal. A normal is the mean of the faces around the vertex, weighted by
/// their angle there. Two faces are smooth across their edge if their normals differ by at most the crease
/// angle. From 180 degrees on, all faces of a vertex are smooth. A triangle that is wound against its
/// neighbours counts as if it were wound as they are, and gets the opposite normals. Needs joined positions
/// and no triangle of zero area.
std::size_t fill_normals(Mesh& mesh, double crease_degrees, bool replace_all);

/// True for the triangles whose back may be in view from outside: those of surfaces that are not closed, not
/// wound consistently, or inside out. Triangles that share an edge (by position indices) belong to one
/// surface. A surface is closed if every edge is used as often in one direction as in the other, and inside
/// out if its volume is negative.
std::vector<bool> shows_back(const Mesh& mesh);

/// True if the sum of a triangle's normals points to its back. The normals of a file may contradict its
/// winding.
bool has_averted_normals(const Scene& scene, const SceneTriangle& triangle);

/// Number of edges (by position indices) without a matching edge in the opposite direction. An edge counts
/// once per missing neighbour. 0 for a closed mesh.
std::size_t open_edges(std::span<const SceneTriangle> triangles);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// A mesh on its way into a scene, and what every mesh needs there: joined vertices, area, normals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/scene.hpp"

namespace halfway {

/// As in Scene, but in the mesh's own space until `transform` takes it to the world.
/// A zero normal stands for "none": `fill_normals` computes it.
struct Mesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;
  std::vector<SceneTriangle> triangles;
  std::vector<Material> materials;
};

/// Gives vertices of equal coordinates one index, so that triangles that touch also share an index.
void join_positions(Mesh& mesh);

/// Moves the mesh by an invertible affine matrix. Normals follow by the inverse transpose; a mirroring matrix
/// turns the triangles round, so that the outside stays outside.
void transform(Mesh& mesh, const glm::dmat4& matrix);

/// Removes triangles whose height is below rounding (1e-12 of their longest edge); returns how many.
std::size_t drop_zero_area(Mesh& mesh);

/// Computes normals for every corner whose normal is missing, or for all with `replace_all`; returns how many
/// corners got one. A normal is the mean of the faces around the vertex, weighted by their angle there. Faces
/// smooth into one another over an edge where their normals differ by no more than the crease angle; from 180
/// degrees on, all faces of a vertex do. Needs joined positions and no zero area.
std::size_t fill_normals(Mesh& mesh, double crease_degrees, bool replace_all);

/// Edges, by position indices, that are not walked as often one way as the other, each as often as it lacks a
/// neighbour: 0 for a closed mesh.
std::size_t open_edges(std::span<const SceneTriangle> triangles);

}  // namespace halfway

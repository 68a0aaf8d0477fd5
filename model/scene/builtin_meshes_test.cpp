// SPDX-License-Identifier: Apache-2.0
#include "scene/builtin_meshes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace halfway {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Number of triangles on each directed edge.
std::map<Edge, int> directed_edges(const Mesh& mesh) {
  std::map<Edge, int> count;
  for (const SceneTriangle& triangle : mesh.triangles) {
    for (int side = 0; side < 3; ++side) {
      ++count[{triangle.position[side], triangle.position[(side + 1) % 3]}];
    }
  }
  return count;
}

/// Edges with a triangle on one side only. Fails if two triangles have an edge in the same direction.
std::vector<Edge> open_edges(const Mesh& mesh) {
  const std::map<Edge, int> edges = directed_edges(mesh);
  std::vector<Edge> open;
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    if (!edges.contains({edge.second, edge.first})) open.push_back(edge);
  }
  return open;
}

glm::dvec3 cross_of(const Mesh& mesh, const SceneTriangle& triangle) {
  const glm::dvec3& a = mesh.positions[triangle.position[0]];
  return glm::cross(mesh.positions[triangle.position[1]] - a, mesh.positions[triangle.position[2]] - a);
}

void expect_unit_normals_on_the_outside(const Mesh& mesh) {
  for (const glm::dvec3& normal : mesh.normals) EXPECT_NEAR(glm::length(normal), 1.0, 4e-16);
  for (const SceneTriangle& triangle : mesh.triangles) {
    const glm::dvec3 face = cross_of(mesh, triangle);
    EXPECT_GT(glm::length(face), 0.0);
    for (const std::uint32_t normal : triangle.normal) EXPECT_GT(glm::dot(face, mesh.normals[normal]), 0.0);
  }
}

void expect_no_position_twice(const Mesh& mesh) {
  std::set<std::vector<double>> seen;
  for (const glm::dvec3& p : mesh.positions) {
    EXPECT_TRUE(seen.insert({p.x, p.y, p.z}).second) << p.x << ' ' << p.y << ' ' << p.z;
  }
}

TEST(UvSphere, HasThePublishedTriangleCounts) {
  const std::pair<std::pair<int, int>, std::size_t> cases[] = {
      {{12, 8}, 168}, {{17, 12}, 374}, {{23, 16}, 690}, {{3, 2}, 6}};
  for (const auto& [size, triangles] : cases) {
    EXPECT_EQ(make_uv_sphere(size.first, size.second, 1.0).triangles.size(), triangles);
    EXPECT_EQ(uv_sphere_triangles(size.first, size.second), triangles);
  }
}

TEST(UvSphere, IsClosedAndFacesOutward) {
  for (const auto& [slices, stacks] : {std::pair{3, 2}, {12, 8}, {17, 12}, {23, 16}}) {
    const Mesh mesh = make_uv_sphere(slices, stacks, 2.5);
    EXPECT_TRUE(open_edges(mesh).empty());
    expect_no_position_twice(mesh);
    for (const SceneTriangle& triangle : mesh.triangles) {
      EXPECT_GT(glm::dot(cross_of(mesh, triangle), mesh.positions[triangle.position[0]]), 0.0);
      for (int corner = 0; corner < 3; ++corner) {
        EXPECT_EQ(mesh.positions[triangle.position[corner]], 2.5 * mesh.normals[triangle.normal[corner]]);
      }
    }
    for (const glm::dvec3& normal : mesh.normals) EXPECT_NEAR(glm::length(normal), 1.0, 4e-16);
  }
}

TEST(Teapot, HasItsTrianglesAndSize) {
  for (const std::uint32_t divisions : {1u, 2u, 3u, 5u, 8u, 13u}) {
    const Mesh mesh = make_teapot(divisions);
    EXPECT_EQ(mesh.triangles.size(), teapot_triangles(divisions));
    expect_no_position_twice(mesh);
    double low = 1.0, high = 0.0;
    for (const glm::dvec3& p : mesh.positions) {
      low = std::min(low, p.y);
      high = std::max(high, p.y);
    }
    EXPECT_EQ(low, 0.0);
    EXPECT_EQ(high, 3.15);
  }
}

TEST(Teapot, IsWatertightBetweenItsSixRims) {
  for (const std::uint32_t divisions : {2u, 3u, 5u, 8u, 11u}) {
    const Mesh mesh = make_teapot(divisions);
    // Pot and lid have one rim of four quarters each. Handle and spout have two rims of two halves each.
    EXPECT_EQ(open_edges(mesh).size(), (4u + 4u + 4u + 4u) * divisions);
    for (const Edge& edge : open_edges(mesh)) {
      const glm::dvec3& p = mesh.positions[edge.first];
      const double radius = std::hypot(p.x, p.z);
      const bool on_pot = p.y == 2.4 && std::abs(radius - 1.4) < 0.02;
      const bool on_lid = p.y == 2.4 && std::abs(radius - 1.3) < 0.02;
      const bool on_handle = std::abs(p.z) <= 0.3 && p.x <= -1.5;
      const bool on_spout = p.x >= 1.69;
      EXPECT_TRUE(on_pot || on_lid || on_handle || on_spout) << p.x << ' ' << p.y << ' ' << p.z;
    }
  }
}

TEST(Teapot, NormalsAreUnitAndOnTheTrianglesSide) {
  for (const std::uint32_t divisions : {8u, 12u, 20u})
    expect_unit_normals_on_the_outside(make_teapot(divisions));
}

TEST(Teapot, NormalsAgreeWithTheFinerMesh) {
  // With many divisions the normal of a face approaches the normal of the surface.
  const Mesh mesh = make_teapot(64);
  for (const SceneTriangle& triangle : mesh.triangles) {
    const glm::dvec3 face = glm::normalize(cross_of(mesh, triangle));
    for (const std::uint32_t normal : triangle.normal) EXPECT_GT(glm::dot(face, mesh.normals[normal]), 0.95);
  }
}

TEST(Teapot, PolesLookUpAndDown) {
  const Mesh mesh = make_teapot(4);
  int poles = 0;
  for (const SceneTriangle& triangle : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      const glm::dvec3& p = mesh.positions[triangle.position[corner]];
      if (p.x != 0.0 || p.z != 0.0) continue;
      ++poles;
      EXPECT_EQ(mesh.normals[triangle.normal[corner]], glm::dvec3(0.0, p.y > 1.0 ? 1.0 : -1.0, 0.0));
    }
  }
  EXPECT_EQ(poles, 2 * 4 * 4);
}

TEST(Box, IsClosedAndFlatOnItsFaces) {
  const glm::dvec3 size(1.0, 2.0, 0.3);
  for (const std::uint32_t divisions : {1u, 2u, 7u}) {
    const Mesh mesh = make_box(size, divisions);
    EXPECT_EQ(mesh.triangles.size(), box_triangles(divisions));
    EXPECT_TRUE(open_edges(mesh).empty());
    expect_no_position_twice(mesh);
    expect_unit_normals_on_the_outside(mesh);
    // Count the vertices of a lattice on the surface of a cube with d + 1 vertices per edge.
    const std::size_t n = divisions + 1;
    EXPECT_EQ(mesh.positions.size(), n * n * n - (n - 2) * (n - 2) * (n - 2));
    double area = 0.0;
    for (const SceneTriangle& triangle : mesh.triangles) {
      const glm::dvec3 normal = mesh.normals[triangle.normal[0]];
      EXPECT_NEAR(glm::length(glm::cross(glm::normalize(cross_of(mesh, triangle)), normal)), 0.0, 1e-12);
      for (const std::uint32_t p : triangle.position)
        EXPECT_EQ(glm::dot(mesh.positions[p], normal), 0.5 * glm::dot(size, glm::abs(normal)));
      area += 0.5 * glm::length(cross_of(mesh, triangle));
    }
    EXPECT_NEAR(area, 2.0 * (1.0 * 2.0 + 2.0 * 0.3 + 0.3 * 1.0), 1e-12);
  }
}

TEST(OpenEdges, AreEdgesWithoutAnOppositeEdge) {
  EXPECT_EQ(halfway::open_edges(make_uv_sphere(12, 8, 1.0).triangles), 0u);
  EXPECT_EQ(halfway::open_edges(make_box({1, 2, 3}, 3).triangles), 0u);
  EXPECT_EQ(halfway::open_edges(make_teapot(5).triangles), 16u * 5u);
  Mesh box = make_box({1, 2, 3}, 1);
  std::swap(box.triangles[4].position[0], box.triangles[4].position[1]);  // now in its neighbours' direction
  EXPECT_EQ(halfway::open_edges(box.triangles), 3u * 2u);
  box.triangles.erase(box.triangles.begin() + 4);
  EXPECT_EQ(halfway::open_edges(box.triangles), 3u);
  box.triangles.push_back(box.triangles[0]);  // three triangles at each of its edges
  EXPECT_EQ(halfway::open_edges(box.triangles), 6u);
  box.triangles = {{{7, 7, 2}, {0, 0, 0}, 0}};
  EXPECT_EQ(halfway::open_edges(box.triangles), 0u);
  EXPECT_EQ(halfway::open_edges({}), 0u);
}

}  // namespace
}  // namespace halfway

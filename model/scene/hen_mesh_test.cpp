// SPDX-License-Identifier: Apache-2.0
#include "scene/hen_mesh.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <set>
#include <tuple>

namespace halfway {
namespace {

TEST(Hen, IsClosedAndFacesOutward) {
  for (const std::uint32_t cells : {4u, 7u, 12u}) {
    SCOPED_TRACE(cells);
    Mesh mesh = make_hen(cells);
    EXPECT_EQ(open_edges(mesh.triangles), 0u);
    EXPECT_EQ(drop_zero_area(mesh), 0u);
    std::set<std::tuple<double, double, double>> seen;
    for (const glm::dvec3& p : mesh.positions) EXPECT_TRUE(seen.emplace(p.x, p.y, p.z).second);
    // The volume is positive if the triangles face outwards.
    double volume = 0.0;
    for (const SceneTriangle& t : mesh.triangles)
      volume += glm::dot(mesh.positions[t.position[0]],
                         glm::cross(mesh.positions[t.position[1]], mesh.positions[t.position[2]])) /
                6.0;
    EXPECT_NEAR(volume, 3.2, 0.4);
  }
}

TEST(Hen, HasTheShapesNormals) {
  const Mesh mesh = make_hen(7);
  EXPECT_GT(mesh.triangles.size(), 1500u);
  EXPECT_LT(mesh.triangles.size(), 2500u);
  std::size_t averted = 0;
  for (const SceneTriangle& t : mesh.triangles) {
    const glm::dvec3& a = mesh.positions[t.position[0]];
    const glm::dvec3 face = glm::cross(mesh.positions[t.position[1]] - a, mesh.positions[t.position[2]] - a);
    for (const std::uint32_t normal : t.normal) {
      EXPECT_NEAR(glm::length(mesh.normals[normal]), 1.0, 1e-15);
      averted += glm::dot(face, mesh.normals[normal]) <= 0.0 ? 1 : 0;
    }
  }
  EXPECT_LT(averted, mesh.triangles.size() / 50);  // only in creases
}

}  // namespace
}  // namespace halfway

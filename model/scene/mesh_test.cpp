// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <span>
#include <utility>
#include <vector>

#include "scene/builtin_meshes.hpp"

namespace halfway {
namespace {

void flip(SceneTriangle& triangle) {
  std::swap(triangle.position[1], triangle.position[2]);
}

void append(Mesh& mesh, const Mesh& other, glm::dvec3 move) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const glm::dvec3& p : other.positions) mesh.positions.push_back(p + move);
  for (SceneTriangle triangle : other.triangles) {
    for (std::uint32_t& index : triangle.position) index += first;
    mesh.triangles.push_back(triangle);
  }
  join_positions(mesh);
}

/// The number of triangles whose back is in view.
std::ptrdiff_t shown(const Mesh& mesh) {
  const std::vector<bool> shows = shows_back(mesh);
  EXPECT_EQ(shows.size(), mesh.triangles.size());
  return std::count(shows.begin(), shows.end(), true);
}

TEST(ShowsBack, ClosedSurfacesHideTheirBacks) {
  EXPECT_EQ(shown({}), 0);
  EXPECT_EQ(shown(make_uv_sphere(12, 8, 1.0)), 0);
  EXPECT_EQ(shown(make_box({1, 2, 3}, 3)), 0);
  Mesh far = make_box({1, 1, 1}, 2);
  for (glm::dvec3& p : far.positions) p += glm::dvec3(1e9, -1e9, 1e9);
  EXPECT_EQ(shown(far), 0);
}

TEST(ShowsBack, AHoleOrAFlippedTriangleOpensItsSurfaceAlone) {
  const Mesh box = make_box({1, 1, 1}, 2);
  Mesh two = box;
  append(two, box, {3, 0, 0});
  EXPECT_EQ(shown(two), 0);
  Mesh hole = two;
  hole.triangles.pop_back();
  EXPECT_EQ(shown(hole), 47);
  EXPECT_FALSE(shows_back(hole)[0]);
  EXPECT_TRUE(shows_back(hole)[48]);
  Mesh mixed = two;
  flip(mixed.triangles[5]);
  EXPECT_EQ(shown(mixed), 48);
  EXPECT_TRUE(shows_back(mixed)[0]);
  EXPECT_FALSE(shows_back(mixed)[48]);
  // Boxes that touch at a corner are two surfaces.
  Mesh touching = box;
  append(touching, box, {1, 1, 1});
  touching.triangles.pop_back();
  EXPECT_EQ(shown(touching), 47);
}

TEST(ShowsBack, ASurfaceThatIsInsideOutShowsIt) {
  Mesh mesh = make_box({1, 1, 1}, 2);
  append(mesh, make_box({1, 1, 1}, 1), {5, 0, 0});
  for (SceneTriangle& triangle : std::span(mesh.triangles).subspan(48)) flip(triangle);
  EXPECT_EQ(shown(mesh), 12);
  EXPECT_TRUE(shows_back(mesh)[48]);
}

// The front and the back of a sheet as triangles of their own have no volume.
TEST(ShowsBack, TwoSheetsBackToBackHideEachOther) {
  Mesh sheet = make_box({1, 1, 1}, 4);
  sheet.triangles.resize(32);
  EXPECT_EQ(shown(sheet), 32);
  for (std::size_t i = 0; i < 32; ++i) {
    sheet.triangles.push_back(sheet.triangles[i]);
    flip(sheet.triangles.back());
  }
  for (glm::dvec3& p : sheet.positions) p = {p.x + 0.1 * p.y, p.y - 0.3 * p.z, p.z + 1e3};
  EXPECT_EQ(shown(sheet), 0);
}

TEST(FillNormals, ATriangleWoundAgainstItsNeighboursGetsTheOppositeOfTheirNormals) {
  const auto normals = [](Mesh mesh, std::size_t triangle, std::size_t corner) {
    EXPECT_EQ(fill_normals(mesh, 180.0, true), 3 * mesh.triangles.size());
    return mesh.normals[mesh.triangles[triangle].normal[corner]];
  };
  const Mesh sphere = make_uv_sphere(12, 8, 1.0);
  Mesh mixed = sphere;
  for (std::size_t i = 1; i < mixed.triangles.size(); i += 3) flip(mixed.triangles[i]);
  flip(mixed.triangles[2]);
  for (std::size_t t = 0; t < sphere.triangles.size(); ++t)
    for (const std::size_t corner : {0, 1, 2}) {
      const bool is_flipped = t % 3 == 1 || t == 2;
      const std::size_t same = is_flipped && corner != 0 ? 3 - corner : corner;
      const glm::dvec3 wanted = normals(sphere, t, corner);
      EXPECT_LT(glm::length(normals(mixed, t, same) - (is_flipped ? -wanted : wanted)), 1e-12) << t;
    }
}

}  // namespace
}  // namespace halfway

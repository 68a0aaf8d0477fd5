// SPDX-License-Identifier: Apache-2.0
#include "setup/shadow_volume.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include "scene/lights.hpp"
#include "shading/effects.hpp"
#include "shading/test/random_solids.hpp"

namespace halfway {
namespace {

/// The winding number of the surface around a point, from the solid angles of its triangles, and its distance
/// from the nearest integer before rounding.
std::pair<int, long double> winding(const std::vector<CornersWorld>& surface, const glm::dvec3& point_world) {
  long double sum = 0.0L;
  for (const CornersWorld& corners : surface) {
    const LongVec a = LongVec(corners[0]) - LongVec(point_world),
                  b = LongVec(corners[1]) - LongVec(point_world),
                  c = LongVec(corners[2]) - LongVec(point_world);
    const long double a_length = glm::length(a), b_length = glm::length(b), c_length = glm::length(c);
    sum += 2.0L * std::atan2(glm::dot(a, glm::cross(b, c)),
                             a_length * b_length * c_length + glm::dot(a, b) * c_length +
                                 glm::dot(b, c) * a_length + glm::dot(c, a) * b_length);
  }
  const long double turns = sum / (4.0L * std::numbers::pi_v<long double>);
  return {static_cast<int>(std::lround(turns)), std::abs(turns - std::round(turns))};
}

/// Number of edges that the surface does not use equally often in both directions. Compared bit for bit.
std::size_t unmatched_edges(const std::vector<CornersWorld>& surface) {
  const auto key = [](const glm::dvec3& p) { return std::tuple(p.x, p.y, p.z); };
  std::map<std::pair<decltype(key({})), decltype(key({}))>, int> net;
  for (const CornersWorld& corners : surface)
    for (int i = 0; i < 3; ++i) {
      const auto from = key(corners[i]), to = key(corners[(i + 1) % 3]);
      if (from < to) ++net[{from, to}];
      if (to < from) --net[{to, from}];
    }
  return static_cast<std::size_t>(
      std::count_if(net.begin(), net.end(), [](const auto& edge) { return edge.second != 0; }));
}

struct Agreement {
  int points = 0, shadowed = 0, in_doubt = 0;
};

/// For points all over the scene, compares the volumes with the triangles facing away from the light between
/// point and light.
void expect_volumes_are_where_no_light_is(const Scene& scene, RandomSolids& random, Agreement& sum) {
  const std::vector<LightRef> lights = shining_lights(scene);
  const auto triangles = all_corners(scene);
  const BoundingSphere sphere = bounding_sphere(scene);
  for (const ShadowVolumes& volumes : make_shadow_volumes(scene, lights)) {
    const std::vector<CornersWorld> surface = closed_surface(scene, volumes);
    ASSERT_EQ(unmatched_edges(surface), 0u) << name_of(volumes.light);
    const LightPoint light = light_of(scene, volumes.light).point;
    for (int i = 0; i < 60; ++i) {
      glm::dvec3 point = sphere.centre_world + sphere.radius * random.cube(0.9);
      if (glm::length(point - sphere.centre_world) > sphere.radius) continue;
      if (i == 0) point = scene.camera.eye_world;
      const Crossings truth = crossings(triangles, point, light);
      const auto [turns, rest] = winding(surface, point);
      ++sum.points;
      if (truth.margin < 1e-9L || rest > 1e-6L) {
        ++sum.in_doubt;
        continue;
      }
      ASSERT_EQ(turns, truth.enters) << name_of(volumes.light);
      if (i == 0) {
        ASSERT_EQ(static_cast<int>(volumes.around_eye), truth.enters) << name_of(volumes.light);
      }
      sum.shadowed += truth.enters > 0;
    }
  }
}

// Open meshes, edges of three triangles, duplicate, reversed and zero-area triangles: every set of triangles
// has a boundary.
TEST(ShadowVolume, OfAnyTrianglesIsClosed) {
  RandomSolids random(3);
  Agreement sum;
  for (int round = 0; round < 60; ++round) {
    Scene scene = random.scene(2);
    std::vector<SceneTriangle>& triangles = scene.triangles;
    const auto any = [&] { return random.whole(0, static_cast<std::uint32_t>(triangles.size()) - 1); };
    for (int i = 0; i < 4; ++i) triangles.erase(triangles.begin() + any());
    for (int i = 0; i < 3; ++i) triangles.push_back(triangles[any()]);
    for (int i = 0; i < 3; ++i) {
      SceneTriangle& turned = triangles[any()];
      std::swap(turned.position[1], turned.position[2]);
    }
    SceneTriangle fin = triangles[any()];  // on an edge of others
    fin.position[2] = static_cast<std::uint32_t>(scene.positions_world.size());
    scene.positions_world.push_back(random.cube(1.5));
    triangles.push_back(fin);
    std::swap(fin.position[0], fin.position[1]);
    triangles.push_back(fin);
    triangles.push_back({{0, 0, 1}, {0, 0, 0}, 0});
    triangles.push_back({{3, 3, 3}, {0, 0, 0}, 0});
    // Equal positions with different numbers, as at a discontinuity of normals.
    const auto copies = static_cast<std::uint32_t>(scene.positions_world.size());
    for (std::uint32_t i = 0; i < copies; ++i) scene.positions_world.push_back(scene.positions_world[i]);
    for (SceneTriangle& t : triangles)
      for (std::uint32_t& p : t.position) p += random.whole(0, 1) * copies;
    expect_volumes_are_where_no_light_is(scene, random, sum);
    if (HasFatalFailure()) FAIL() << "round " << round;
  }
  EXPECT_GT(sum.points, 5'000);
  EXPECT_GT(sum.shadowed, 500);
  EXPECT_EQ(sum.in_doubt, 0);
}

TEST(ShadowVolume, SidesStartOnlyAtTheSilhouette) {
  Scene scene;
  add_mesh(scene, make_box(glm::dvec3(2.0), 3));
  const std::vector<LightRef> sun{{LightKind::directional, 0}};
  scene.directional = {{{0, 1, 0}, {}}};
  EXPECT_EQ(make_shadow_volumes(scene, sun)[0].averted.size(), 18u);  // the faces at the sides are edge-on
  EXPECT_EQ(make_shadow_volumes(scene, sun)[0].sides.size(), 2u * 12u);
  scene.directional[0].to_light_world = glm::normalize(glm::dvec3(1, 2, 3));
  EXPECT_EQ(make_shadow_volumes(scene, sun)[0].averted.size(), 54u);
  EXPECT_EQ(make_shadow_volumes(scene, sun)[0].sides.size(), 2u * 18u);
  // Gives every triangle its own vertex numbers.
  std::vector<glm::dvec3> apart;
  for (SceneTriangle& t : scene.triangles)
    for (std::uint32_t& p : t.position) {
      apart.push_back(scene.positions_world[p]);
      p = static_cast<std::uint32_t>(apart.size() - 1);
    }
  scene.positions_world = apart;
  EXPECT_EQ(make_shadow_volumes(scene, sun)[0].sides.size(), 2u * 18u);
  // Another box that touches it: at the common edges, equal positions have different numbers.
  Mesh other = make_box(glm::dvec3(2.0), 3);
  for (glm::dvec3& p : other.positions) p += glm::dvec3(2.0, 0.0, 0.0);
  add_mesh(scene, other);
  const ShadowVolumes volumes = make_shadow_volumes(scene, sun)[0];
  for (const CornersWorld& side : volumes.sides) {
    const glm::dvec3 normal = glm::cross(side[1] - side[0], side[2] - side[0]);
    EXPECT_NEAR(glm::dot(glm::normalize(normal), scene.directional[0].to_light_world), 0.0, 1e-12);
  }
  EXPECT_EQ(unmatched_edges(closed_surface(scene, volumes)), 0u);
}

TEST(ShadowVolume, CoordinatesStayInRange) {
  RandomSolids random(5);
  for (int round = 0; round < 100; ++round) {
    Scene scene = random.scene(2);
    scene.camera.eye_world = random.within(0.1, 60.0) * random.unit();
    // A light close to a vertex, and exactly at it.
    if (round % 2) scene.positional[0].position_world = scene.positions_world[4] + 1e-3 * random.unit();
    if (round % 8 == 0) scene.positional[0].position_world = scene.positions_world[4];
    for (const ShadowVolumes& volumes : make_shadow_volumes(scene, shining_lights(scene)))
      for (const CornersWorld& triangle : closed_surface(scene, volumes))
        for (const glm::dvec3& p : triangle) {
          ASSERT_LT(glm::length(p), 1e9);
        }
  }
}

}  // namespace
}  // namespace halfway

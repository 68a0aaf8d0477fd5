// SPDX-License-Identifier: Apache-2.0
#include "reference/ray_cast.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shading/test/random_solids.hpp"

namespace halfway {
namespace {

constexpr LightRef c_sun{LightKind::directional, 0}, c_lamp{LightKind::positional, 0};

bool blocked_by_search(const Scene& scene, const LightRay& ray, double least_way) {
  return std::any_of(scene.triangles.begin(), scene.triangles.end(), [&](const SceneTriangle& t) {
    return ray.hit(corners_world(scene, t), least_way).crossing == Crossing::enters;
  });
}

/// A layer of `triangles` unconnected triangles, some of them twice.
Scene loose(RandomSolids& random, int triangles, double size, const glm::dvec3& spread) {
  Scene scene;
  scene.materials.emplace_back();
  scene.normals_world = {{0, 0, 1}};
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(triangles); ++i) {
    const glm::dvec3 middle = spread * random.cube(1.0);
    for (int k = 0; k < 3; ++k) scene.positions_world.push_back(middle + size * random.cube(1.0));
    scene.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, {0, 0, 0}, 0});
    if (i % 3 == 0) scene.triangles.push_back(scene.triangles.back());
  }
  return scene;
}

TEST(ShadowRays, AgreeWithALinearSearch) {
  RandomSolids random(1);
  int blocked = 0, rays_cast = 0;
  for (int round = 0; round < 60; ++round) {
    const glm::dvec3 spread = round % 3 == 0   ? glm::dvec3(1.0)
                              : round % 3 == 1 ? glm::dvec3(1.0, 0.0, 1.0)
                                               : glm::dvec3(1e-3, 100.0, 1e-3);
    const Scene scene =
        round % 4 == 3 ? random.scene(4) : loose(random, 1 + 40 * (round % 8), 0.1 + 0.03 * round, spread);
    const ShadowRays rays(scene);
    for (int i = 0; i < 400; ++i) {
      const glm::dvec3 from =
          i % 5 == 0 ? scene.positions_world[random.whole(0, 2)] : 1.5 * spread * random.cube(1.0);
      LightPoint light{random.unit(), 0.0};
      // Rays towards points, including vertices, and along the axes.
      if (i % 3 == 1) light = {2.0 * spread * random.cube(1.0) + 0.1 * random.unit(), 1.0};
      if (i % 3 == 2 && i % 2) light = {scene.positions_world.back(), 1.0};
      if (i % 3 == 2 && i % 4 == 0) light = {{0, i % 8 ? 1 : -1, 0}, 0.0};
      if (light.way_from(from) == glm::dvec3(0.0)) continue;
      const LightRay ray(from, light);
      const double least_way = i % 7 == 0 ? 0.2 : 0.0;
      const bool truth = blocked_by_search(scene, ray, least_way);
      ASSERT_EQ(rays.is_blocked(ray, least_way), truth) << round << ' ' << i;
      blocked += truth;
      ++rays_cast;
    }
  }
  EXPECT_GT(blocked, rays_cast / 5);
  EXPECT_LT(blocked, rays_cast / 5 * 4);
}

// Coordinates that are no numbers, or too large for the tree's bins.
TEST(ShadowRays, HostileCoordinatesBlockTheSameRays) {
  RandomSolids random(32);
  for (const double value : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1.7e308, -1.7e308, 1e155, -1e100, 5e-324})
    for (int axis = 0; axis < 3; ++axis) {
      Scene scene = loose(random, 60, 0.5, glm::dvec3(1.0));
      for (const std::size_t vertex : {0U, 1U, 5U, 9U, 10U, 11U, 60U})
        scene.positions_world[vertex][axis] = value;
      const ShadowRays rays(scene);
      for (int i = 0; i < 50; ++i) {
        const LightRay ray(2.0 * random.cube(1.0), {random.unit(), 0.0});
        ASSERT_EQ(rays.is_blocked(ray, 1e-6), blocked_by_search(scene, ray, 1e-6)) << value << ' ' << axis;
      }
    }
}

TEST(ShadowRays, ManyTrianglesInOnePlaceStillFormATree) {
  Scene scene;
  scene.positions_world = {{-1, 0, -1}, {2, 0, -1}, {-1, 0, 2}};
  scene.normals_world = {{0, -1, 0}};
  for (int i = 0; i < 3000; ++i) scene.triangles.push_back({{0, 1, 2}, {0, 0, 0}, 0});
  const ShadowRays rays(scene);
  EXPECT_TRUE(rays.is_blocked(LightRay({0, -1, 0}, {{0, 1, 0}, 0.0}), 0.0));
  EXPECT_FALSE(rays.is_blocked(LightRay({0, 1, 0}, {{0, 1, 0}, 0.0}), 0.0));
  EXPECT_FALSE(ShadowRays(Scene{}).is_blocked(LightRay({0, 1, 0}, {{0, 1, 0}, 0.0}), 0.0));
}

// A convex solid shadows itself exactly where its triangles face away from the light. Rounding causes no
// error at any point.
TEST(ShadowRays, AConvexSolidNeverShadowsItsLitSide) {
  RandomSolids random(4);
  int lit = 0, dark = 0;
  for (int round = 0; round < 300; ++round) {
    Scene scene;
    Mesh mesh = random.solid(1.0);
    if (round % 3 == 0) transform(mesh, glm::translate(glm::dmat4(1.0), 1e4 * random.unit()));
    if (round % 3 == 1) mesh = make_uv_sphere(40, 20, 1.0);
    add_mesh(scene, mesh);
    const glm::dvec3 near = scene.positions_world[0];
    scene.directional = {{random.unit(), {}}};
    scene.positional = {{near + random.within(2.5, 9.0) * random.unit(), {}}};
    const ShadowRays rays(scene);
    for (int i = 0; i < 300; ++i) {
      const auto t = random.whole(0, static_cast<std::uint32_t>(scene.triangles.size()) - 1);
      const auto [a, b, c] = corners_world(scene, scene.triangles[t]);
      // Includes corners and edges.
      double u = random.within(0.0, 1.0), v = random.within(0.0, 1.0);
      if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
      if (i % 4 == 1) u = 0.0;
      if (i % 4 == 2) v = 1.0 - u;
      if (i % 4 == 3) u = v = 0.0;
      const glm::dvec3 point = (1.0 - u - v) * a + u * b + v * c;
      for (const LightRef light : {c_sun, c_lamp}) {
        const LightPoint from = light_of(scene, light).point;
        const glm::dvec3 way = from.way_from(point), normal = glm::cross(b - a, c - a);
        // Edge-on: both results are correct.
        if (std::abs(glm::dot(way, normal)) < 1e-6 * glm::length(way) * glm::length(normal)) continue;
        const bool is_lit = !is_averted({a, b, c}, from);
        ASSERT_EQ(rays.reaches(light, point, t), is_lit) << round;
        ++(is_lit ? lit : dark);
      }
    }
  }
  EXPECT_GT(lit, 50'000);
  EXPECT_GT(dark, 50'000);
}

// A sheet that touches the ground does not shadow it. Slightly above the ground it does.
TEST(ShadowRays, TouchingIsNotShadowing) {
  for (const double height : {0.0, 1e-12, 1e-7, 0.1}) {
    Scene scene;
    scene.positions_world = {{-9, 0, 9},       {9, 0, 9},       {0, 0, -9},
                             {-1, height, -1}, {1, height, -1}, {0, height, 1}};
    scene.normals_world = {{0, 1, 0}, {0, -1, 0}};
    scene.triangles = {{{0, 1, 2}, {0, 0, 0}, 0}, {{3, 4, 5}, {1, 1, 1}, 0}};
    scene.directional = {{glm::normalize(glm::dvec3(0.1, 1, 0)), {}}};
    EXPECT_EQ(ShadowRays(scene).reaches(c_sun, {0, 0, 0}, 0), height < 1e-9) << height;
  }
}

}  // namespace
}  // namespace halfway

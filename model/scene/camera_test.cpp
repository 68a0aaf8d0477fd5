// SPDX-License-Identifier: Apache-2.0
#include "scene/camera.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "scene/builtin_meshes.hpp"

namespace halfway {
namespace {

Scene sphere_scene(const glm::dvec3& centre, double radius) {
  Scene scene;
  const Mesh mesh = make_uv_sphere(64, 64, radius);
  scene.triangles = mesh.triangles;
  for (const glm::dvec3& p : mesh.positions) scene.positions_world.push_back(p + centre);
  return scene;
}

TEST(ViewBasis, IsOrthonormalAndRightHanded) {
  const Camera camera{.eye_world = {3.0, 2.0, 5.0}, .target_world = {0.5, -1.0, 0.0}};
  const ViewBasis basis = view_basis(camera);
  EXPECT_NEAR(glm::length(basis.right_world), 1.0, 1e-15);
  EXPECT_NEAR(glm::length(basis.up_world), 1.0, 1e-15);
  EXPECT_NEAR(glm::dot(basis.right_world, camera.up_world), 0.0, 1e-15);
  EXPECT_GT(glm::dot(basis.up_world, camera.up_world), 0.0);
  EXPECT_NEAR(glm::length(glm::cross(basis.right_world, basis.up_world) - basis.backward_world), 0.0, 1e-15);
  EXPECT_GT(glm::dot(basis.backward_world, camera.eye_world - camera.target_world), 0.0);
}

TEST(HasView, NeedsTwoPointsAndAnUpNotParallelToThem) {
  EXPECT_TRUE(has_view({}));
  EXPECT_FALSE(has_view({.eye_world = {1.0, 2.0, 3.0}, .target_world = {1.0, 2.0, 3.0}}));
  EXPECT_FALSE(has_view({.eye_world = {0.0, 7.0, 0.0}}));
  EXPECT_FALSE(has_view({.up_world = {0.0, 0.0, 0.0}}));
  EXPECT_TRUE(has_view({.eye_world = {0.0, 7.0, 0.0}, .up_world = {0.0, 0.0, 1.0}}));
}

TEST(FitCamera, FillsTheNarrowerSideExceptTheMargin) {
  for (const double fov : {5.0, 40.0, 100.0, 170.0}) {
    const Scene scene = sphere_scene({3.0, -2.0, 7.0}, 2.0);
    const BoundingSphere sphere = bounding_sphere(scene);
    EXPECT_NEAR(sphere.radius, 2.0, 1e-12);
    const Camera camera = fit_camera(sphere, {0.4, 0.3, 1.0}, {0.0, 1.0, 0.0}, fov);
    const ViewBasis basis = view_basis(camera);
    double top = 0.0, side = 0.0;
    for (const glm::dvec3& p : scene.positions_world) {
      const glm::dvec3 to = p - camera.eye_world;
      const double depth = -glm::dot(to, basis.backward_world);
      const double half_height = depth * std::tan(glm::radians(fov / 2));
      top = std::max(top, std::abs(glm::dot(to, basis.up_world)) / half_height);
      side = std::max(side, std::abs(glm::dot(to, basis.right_world)) / (half_height * c_fit_aspect));
    }
    EXPECT_LT(top, 1.0);
    EXPECT_LT(side, 1.0);
    // The sine of the angle to the horizon is 1 / 1.05 times the sine of half the field of view.
    const double horizon = std::asin(std::sin(glm::radians(fov / 2)) / (1.0 + c_fit_margin));
    EXPECT_NEAR(top, std::tan(horizon) / std::tan(glm::radians(fov / 2)), 0.01);
  }
}

TEST(DepthRange, ContainsTheSceneInFrontOfTheEye) {
  const Scene scene = sphere_scene({0.0, 0.0, 0.0}, 1.0);
  const DepthRange range = depth_range({.eye_world = {0.0, 0.0, 5.0}}, bounding_sphere(scene));
  EXPECT_LT(range.near, 4.0);
  EXPECT_GT(range.near, 3.99);
  EXPECT_GT(range.far, 6.0);
  EXPECT_LT(range.far, 6.01);
}

TEST(DepthRange, KeepsAThousandthOfFarWhereTheEyeIsCloseOrInside) {
  const BoundingSphere sphere{{0.0, 0.0, 0.0}, 1.0};
  for (const double distance : {0.5, 1.0, 1.0005}) {
    const DepthRange range = depth_range({.eye_world = {0.0, 0.0, distance}}, sphere);
    EXPECT_EQ(range.near, 1e-3 * range.far);
    EXPECT_GT(range.far, 1.0 + distance);
  }
}

TEST(DepthRange, IsAlwaysARange) {
  const BoundingSphere sphere{{0.0, 0.0, 0.0}, 1.0};
  for (const double near : {0.0, 0.1, 50.0}) {
    for (const double z : {-100.0, -5.0, -1.0, 0.0, 1.0, 5.0, 100.0}) {
      const Camera camera{.eye_world = {0.0, 0.0, z}, .target_world = {0.0, 0.0, z - 1.0}, .near = near};
      const DepthRange range = depth_range(camera, sphere);
      EXPECT_GT(range.near, 0.0);
      EXPECT_GT(range.far, range.near);
      EXPECT_TRUE(near == 0.0 || range.near == near);
    }
  }
  const DepthRange given = depth_range({.near = 2.0, .far = 3.0}, sphere);
  EXPECT_EQ(given.near, 2.0);
  EXPECT_EQ(given.far, 3.0);
}

}  // namespace
}  // namespace halfway

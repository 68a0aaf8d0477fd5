// SPDX-License-Identifier: Apache-2.0
#include "scene/turntable.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "scene/camera.hpp"

namespace halfway {
namespace {

TEST(Turntable, QuarterTurnsAreExact) {
  const Camera camera{
      .eye_world = {1.0, 3.0, 10.0}, .target_world = {1.0, 2.0, 0.5}, .near = 0.25, .far = 40.0};
  const glm::dvec3 eyes[] = {{1.0, 3.0, 10.0}, {10.5, 3.0, 0.5}, {1.0, 3.0, -9.0}, {-8.5, 3.0, 0.5}};
  for (std::uint32_t quarter = 0; quarter < 4; ++quarter)
    for (const std::uint32_t steps : {1U, 3U, 2500U}) {
      const Camera at = turned(camera, quarter * steps, 4 * steps);
      EXPECT_EQ(at.eye_world, eyes[quarter]) << quarter << " of " << steps;
      EXPECT_EQ(at.target_world, camera.target_world);
      EXPECT_EQ(at.up_world, camera.up_world);
      EXPECT_EQ(at.vertical_fov_degrees, camera.vertical_fov_degrees);
      EXPECT_EQ(at.near, 0.25);
      EXPECT_EQ(at.far, 40.0);
    }
}

TEST(Turntable, StepsAreEvenAndKeepHeightAndDistance) {
  // Up is neither of length 1 nor perpendicular to the viewing axis.
  const Camera camera{
      .eye_world = {2.0, -1.0, 5.0}, .target_world = {0.5, 0.5, -1.0}, .up_world = {0.3, 2.0, 0.1}};
  const glm::dvec3 axis = glm::normalize(camera.up_world);
  const auto backward = [&](std::uint32_t frame) {
    return turned(camera, frame, 7).eye_world - camera.target_world;
  };
  const auto around = [&](glm::dvec3 v) { return glm::normalize(v - glm::dot(v, axis) * axis); };
  for (std::uint32_t frame = 0; frame < 7; ++frame) {
    const glm::dvec3 here = backward(frame), next = frame == 6 ? backward(0) : backward(frame + 1);
    EXPECT_NEAR(glm::length(here), glm::length(backward(0)), 1e-14);
    EXPECT_NEAR(glm::dot(here, axis), glm::dot(backward(0), axis), 1e-14);
    EXPECT_NEAR(glm::dot(around(here), around(next)), 0.62348980185873353, 1e-14);  // cos 360°/7
    EXPECT_GT(glm::dot(glm::cross(around(here), around(next)), axis), 0.0);         // counter-clockwise
    EXPECT_TRUE(has_view(turned(camera, frame, 7)));
  }
}

TEST(Turntable, OrbitsByAngles) {
  const Camera camera{
      .eye_world = {2.0, -1.0, 5.0}, .target_world = {0.5, 0.5, -1.0}, .up_world = {0.3, 2.0, 0.1}};
  EXPECT_EQ(orbited(camera, 0.0, 0.0, 1.0).eye_world, camera.eye_world);
  // Azimuth turns as the turntable does.
  for (const std::uint32_t frame : {1U, 7U, 20U}) {
    const glm::dvec3 eye = orbited(camera, 10.0 * frame, 0.0, 1.0).eye_world;
    EXPECT_LT(glm::distance(eye, turned(camera, frame, 36).eye_world), 1e-14);
  }
  // Elevation raises the eye, and ends before the axis.
  const glm::dvec3 axis = glm::normalize(camera.up_world);
  const auto from_axis = [&](double elevation) {
    const Camera at = orbited(camera, 30.0, elevation, 2.0);
    EXPECT_TRUE(has_view(at));
    EXPECT_NEAR(glm::distance(at.eye_world, at.target_world),
                2.0 * glm::distance(camera.eye_world, camera.target_world), 1e-13);
    return glm::degrees(std::acos(glm::dot(axis, glm::normalize(at.eye_world - at.target_world))));
  };
  EXPECT_NEAR(from_axis(25.0), from_axis(0.0) - 25.0, 1e-12);
  EXPECT_NEAR(from_axis(-25.0), from_axis(0.0) + 25.0, 1e-12);
  EXPECT_NEAR(from_axis(500.0), c_least_pole_degrees, 1e-10);
  EXPECT_NEAR(from_axis(-500.0), 180.0 - c_least_pole_degrees, 1e-10);
}

}  // namespace
}  // namespace halfway

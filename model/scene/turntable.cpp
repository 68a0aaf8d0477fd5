// SPDX-License-Identifier: Apache-2.0
#include "scene/turntable.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace halfway {
namespace {

struct Angle {
  double sine, cosine;
};

// Multiples of a quarter turn are exact, so that the eye is where a reader of the scene file expects it.
Angle part_of_turn(std::uint32_t frame, std::uint32_t frames) {
  const std::uint64_t quarters = 4 * std::uint64_t{frame};
  const double rest =
      0.5 * std::numbers::pi * static_cast<double>(quarters % frames) / static_cast<double>(frames);
  Angle angle{std::sin(rest), std::cos(rest)};
  for (std::uint64_t i = quarters / frames; i > 0; --i) angle = {angle.cosine, -angle.sine};
  return angle;
}

}  // namespace

Camera turned(const Camera& camera, std::uint32_t frame, std::uint32_t frames) {
  if (frame == 0) return camera;
  const auto [sine, cosine] = part_of_turn(frame, frames);
  const glm::dvec3 axis_world = glm::normalize(camera.up_world);
  const glm::dvec3 backward_world = camera.eye_world - camera.target_world;
  const glm::dvec3 along_axis_world = glm::dot(axis_world, backward_world) * axis_world;
  Camera out = camera;
  out.eye_world = camera.target_world + along_axis_world + cosine * (backward_world - along_axis_world) +
                  sine * glm::cross(axis_world, backward_world);
  return out;
}

Camera orbited(const Camera& camera, double azimuth_degrees, double elevation_degrees,
               double distance_factor) {
  Camera out = camera;
  const glm::dvec3 axis_world = glm::normalize(camera.up_world);
  const auto rotate = [&](double degrees, const glm::dvec3& axis) {
    const glm::dvec3 backward_world = out.eye_world - out.target_world;
    out.eye_world = out.target_world +
                    glm::dmat3(glm::rotate(glm::dmat4(1.0), glm::radians(degrees), axis)) * backward_world;
  };
  if (azimuth_degrees != 0.0) rotate(azimuth_degrees, axis_world);
  if (elevation_degrees != 0.0) {
    const glm::dvec3 to_eye_world = glm::normalize(out.eye_world - out.target_world);
    const double from_axis =
        glm::degrees(std::acos(std::clamp(glm::dot(axis_world, to_eye_world), -1.0, 1.0)));
    const double wanted =
        std::clamp(from_axis - elevation_degrees, c_least_pole_degrees, 180.0 - c_least_pole_degrees);
    rotate(wanted - from_axis, glm::normalize(glm::cross(axis_world, to_eye_world)));
  }
  if (distance_factor != 1.0)
    out.eye_world = out.target_world + distance_factor * (out.eye_world - out.target_world);
  return out;
}

}  // namespace halfway

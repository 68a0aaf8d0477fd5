// SPDX-License-Identifier: Apache-2.0
#include "scene/camera.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

namespace halfway {

namespace {

// Least sine of the angle between up and the viewing axis. Below it, rounding would determine the roll.
constexpr double c_min_up_sine = 1e-6;
// Margin that keeps vertices on the sphere inside the range despite the rounding of a projection.
constexpr double c_depth_slack = 1e-3;

}  // namespace

bool has_view(const Camera& camera) {
  const glm::dvec3 backward = camera.eye_world - camera.target_world;
  const double distance = glm::length(backward);
  const double up_length = glm::length(camera.up_world);
  // If the distance from eye to target is of the size of rounding, the view has no direction.
  const double size = std::max(glm::length(camera.eye_world), glm::length(camera.target_world));
  if (!(distance > size * 1e-12) || !(up_length > 0.0)) return false;
  const glm::dvec3 sine = glm::cross(camera.up_world / up_length, backward / distance);
  return glm::length(sine) > c_min_up_sine;
}

ViewBasis view_basis(const Camera& camera) {
  const glm::dvec3 backward = glm::normalize(camera.eye_world - camera.target_world);
  const glm::dvec3 right = glm::normalize(glm::cross(glm::normalize(camera.up_world), backward));
  return {right, glm::cross(backward, right), backward};
}

BoundingSphere bounding_sphere(const Scene& scene) {
  if (scene.triangles.empty()) return {};
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high = -low;
  for (const SceneTriangle& triangle : scene.triangles) {
    for (const std::uint32_t index : triangle.position) {
      low = glm::min(low, scene.positions_world[index]);
      high = glm::max(high, scene.positions_world[index]);
    }
  }
  const glm::dvec3 centre = 0.5 * (low + high);
  double radius2 = 0.0;
  for (const SceneTriangle& triangle : scene.triangles) {
    for (const std::uint32_t index : triangle.position) {
      const glm::dvec3 from_centre = scene.positions_world[index] - centre;
      radius2 = std::max(radius2, glm::dot(from_centre, from_centre));
    }
  }
  return {centre, std::sqrt(radius2)};
}

DepthRange depth_range(const Camera& camera, const BoundingSphere& sphere) {
  const glm::dvec3 to_centre = sphere.centre_world - camera.eye_world;
  const double centre_depth = -glm::dot(to_centre, view_basis(camera).backward_world);
  const double back = centre_depth + sphere.radius * (1.0 + c_depth_slack);
  const double front = centre_depth - sphere.radius * (1.0 + c_depth_slack);

  double far = camera.far;
  if (far <= 0.0) {
    far = back;
    // The scene lies entirely behind the eye or in front of the near plane. Any range shows nothing, as it
    // should.
    if (far <= camera.near) far = camera.near > 0.0 ? 2.0 * camera.near : glm::length(to_centre);
    if (far <= 0.0) far = 1.0;
  }
  double near = camera.near;
  if (near <= 0.0) {
    const bool inside = glm::length(to_centre) <= sphere.radius;
    near = c_near_part_of_far * far;
    if (!inside && front < far) near = std::max(near, front);
  }
  return {near, far};
}

Camera fit_camera(const BoundingSphere& sphere, const glm::dvec3& to_eye_world, const glm::dvec3& up_world,
                  double vertical_fov_degrees) {
  const double half_height = std::tan(0.5 * glm::radians(vertical_fov_degrees));
  const double half_width = half_height * c_fit_aspect;
  // The sphere touches the planes of the nearer pair of sides, so use the sine of the half angle, not its
  // tangent.
  const double half_angle = std::atan(std::min(half_height, half_width));
  const double radius = sphere.radius > 0.0 ? sphere.radius : 1.0;
  const double distance = radius * (1.0 + c_fit_margin) / std::sin(half_angle);

  Camera camera;
  camera.target_world = sphere.centre_world;
  camera.eye_world = sphere.centre_world + distance * glm::normalize(to_eye_world);
  camera.up_world = up_world;
  camera.vertical_fov_degrees = vertical_fov_degrees;
  return camera;
}

}  // namespace halfway

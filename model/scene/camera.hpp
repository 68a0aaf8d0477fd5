// SPDX-License-Identifier: Apache-2.0
// The axes and the depth range of a camera, and a camera fitted to a scene.
#pragma once

#include <glm/vec3.hpp>

#include "scene/scene.hpp"

namespace halfway {

/// Aspect ratio (width / height) of the frame for which a camera is fitted.
inline constexpr double c_fit_aspect = 4.0 / 3.0;
/// Margin around a fitted scene, relative to its size.
inline constexpr double c_fit_margin = 0.05;
/// A near plane that is fitted to a sphere is at least this part of far.
inline constexpr double c_near_part_of_far = 1e-3;

/// Orthonormal and right-handed: x right, y up, z from the scene back to the eye.
struct ViewBasis {
  glm::dvec3 right_world;
  glm::dvec3 up_world;
  glm::dvec3 backward_world;
};

struct BoundingSphere {
  glm::dvec3 centre_world{0.0};
  double radius = 0.0;
};

/// Distances along the viewing axis, 0 < near < far.
struct DepthRange {
  double near;
  double far;
};

/// True if eye and target differ and up is not parallel to the line between them.
bool has_view(const Camera& camera);

/// Axes of a camera. Requires `has_view`.
ViewBasis view_basis(const Camera& camera);

/// A sphere around every vertex that a triangle uses. Its centre is the centre of their bounding box.
BoundingSphere bounding_sphere(const Scene& scene);

/// The camera's own near and far where they are given (> 0), whatever is in view. Otherwise they are fitted
/// to the sphere: near is the sphere's nearest point but at least `c_near_part_of_far` of far; far is
/// slightly beyond its farthest point.
DepthRange depth_range(const Camera& camera, const BoundingSphere& sphere);

/// A camera on the ray from the sphere's centre along `to_eye_world`. It shows the whole sphere in a frame of
/// `c_fit_aspect`, with `c_fit_margin` around it. `to_eye_world` must not be zero or parallel to `up_world`.
Camera fit_camera(const BoundingSphere& sphere, const glm::dvec3& to_eye_world,
                  const glm::dvec3& up_world = {0.0, 1.0, 0.0}, double vertical_fov_degrees = 40.0);

}  // namespace halfway

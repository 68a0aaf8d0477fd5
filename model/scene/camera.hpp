// SPDX-License-Identifier: Apache-2.0
// The camera's frame of axes, its depth range, and the camera that just sees a scene.
#pragma once

#include <glm/vec3.hpp>

#include "scene/scene.hpp"

namespace halfway {

/// Width over height that a fitted camera is made for.
inline constexpr double c_fit_aspect = 4.0 / 3.0;
/// Free room around a fitted scene, as a part of its size.
inline constexpr double c_fit_margin = 0.05;

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

/// Is there a view, that is: are eye and target apart, and is up not along the line between them?
bool has_view(const Camera& camera);

/// Axes of a camera for which `has_view` holds.
ViewBasis view_basis(const Camera& camera);

/// A sphere around every vertex that a triangle uses, centred in their bounding box.
BoundingSphere bounding_sphere(const Scene& scene);

/// The camera's own near and far where it gives them (> 0), else the ends of the sphere as the eye sees it:
/// near is where the sphere begins but at least a thousandth of far, far is a little behind its back.
DepthRange depth_range(const Camera& camera, const BoundingSphere& sphere);

/// A camera on the ray from the sphere's centre along `to_eye_world` that sees the whole sphere in a frame of
/// `c_fit_aspect`, with `c_fit_margin` around it. `to_eye_world` must not be zero or parallel to `up_world`.
Camera fit_camera(const BoundingSphere& sphere, const glm::dvec3& to_eye_world,
                  const glm::dvec3& up_world = {0.0, 1.0, 0.0}, double vertical_fov_degrees = 40.0);

}  // namespace halfway

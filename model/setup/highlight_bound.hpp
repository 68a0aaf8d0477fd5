// SPDX-License-Identifier: Apache-2.0
// Does a quadratic through six samples stand for the radiance over the whole triangle, or must it be split?
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "scene/scene.hpp"
#include "setup/project.hpp"

namespace halfway {

/// What the test sees of a triangle: its surface at the three vertices, then at the midpoints of edges 1-2,
/// 1-3, 2-3.
struct SampledTriangle {
  std::array<SurfacePoint, 6> surface;
  std::array<glm::dvec3, 6> radiance;
};

/// Published test (quadratic paper, section 4): how far the quadratic is from the radiance at the centroid,
/// in colour steps of 1/255, the largest channel. At the centroid the quadratic is (4 sum of midpoints - sum
/// of vertices)/9.
double centroid_error(const SampledTriangle& triangle, const glm::dvec3& centroid_radiance);

/// How far, in colour steps, the quadratic may be from the radiance anywhere on the triangle for what six
/// samples and the centroid do not show: a highlight between them, the terminator's bend, a spot's edge. For
/// each light the angle between normal and halfway (Blinn, Cook-Torrance) or between reflected light and eye
/// (Phong) is bounded from below by the samples, or by cones around the vertices' directions where these are
/// wide, and with it the highlight and its third derivative. Calibrated, not proved: of random triangles on
/// which this and `centroid_error` are at most T = 2, Blinn's and Phong's error passed 2 T on one in 200,000,
/// and was 3.5 T at most (highlight_bound_test.cpp draws them).
double missed_highlight_bound(const Scene& scene, const Material& material, const SampledTriangle& triangle);

}  // namespace halfway

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

/// An upper bound, in colour steps, on what the samples may miss of highlights and spot cones anywhere on the
/// triangle. For each light: the least angle that cones around the normals and around the halfway (Blinn,
/// Cook-Torrance) or reflected (Phong) vectors leave between the two bounds the highlight from above; it is 0
/// where the highlight stays below `threshold` or varies so slowly that a quadratic follows it to
/// `threshold`.
double missed_highlight_bound(const Scene& scene, const Material& material, const SampledTriangle& triangle,
                              double threshold);

}  // namespace halfway

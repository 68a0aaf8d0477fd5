// SPDX-License-Identifier: Apache-2.0
// Decides whether a quadratic through six samples approximates the radiance over the whole triangle, or
// whether the triangle must be split.
#pragma once

#include <glm/vec3.hpp>

#include "scene/scene.hpp"
#include "setup/sampled_triangle.hpp"

namespace halfway {

/// Published test (quadratic paper, section 4): the difference between the quadratic and the radiance at the
/// centroid, in colour steps of 1/255, of the channel with the largest difference. At the centroid the
/// quadratic is (4 sum of midpoints - sum of vertices)/9.
double centroid_error(const SampledTriangle& triangle, const glm::dvec3& centroid_radiance);

/// Greatest difference, in colour steps, between the quadratic and the radiance anywhere on the triangle that
/// the six samples and the centroid do not show: a highlight between them, the bend at the terminator, the
/// edge of a spot. For each light the angle between normal and halfway vector (Blinn, Cook-Torrance) or
/// between reflected light and eye (Phong) has a lower bound. It is found from the samples, or from cones
/// around the directions at the vertices if these are wide. It bounds the highlight and its third derivative.
/// Calibrated, not proved: for random triangles on which this value and `centroid_error` are at most T = 2,
/// the error of Blinn and Phong exceeded 2 T on one of 200,000 and was at most 3.5 T
/// (highlight_bound_test.cpp draws them; `make search` draws others). `proved_bound` is an upper bound, and
/// greater.
double missed_highlight_bound(const Scene& scene, const Material& material, const SampledTriangle& triangle);

/// missed_highlight_bound(...) > steps. For most triangles a simpler bound decides.
bool may_miss_highlight(const Scene& scene, const Material& material, const SampledTriangle& triangle,
                        double steps);

}  // namespace halfway

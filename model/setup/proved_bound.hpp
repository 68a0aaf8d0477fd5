// SPDX-License-Identifier: Apache-2.0
// Upper bound of the error of a quadratic through six samples of the radiance, anywhere on the triangle.
#pragma once

#include <span>

#include "scene/lights.hpp"
#include "scene/scene.hpp"
#include "setup/sampled_triangle.hpp"

namespace halfway {

/// Error of the quadratic through six samples, if the third or the second derivative along each edge is at
/// most 1, and if the function is from 0 to 1. The size of a step in the triangle is its largest change of a
/// barycentric coordinate: an edge has size 1.
inline constexpr double c_of_third = 0.0265, c_of_second = 0.149, c_of_range = 4.0 / 3;
/// The same for max(0, x) with a linear x whose range on the triangle is 1.
inline constexpr double c_of_bend = 0.097;
/// Error of the plane through three vertices, if the second derivative is at most 1; greatest sum of the
/// weights of six samples, as absolute values, and of those at the midpoints.
inline constexpr double c_of_plane = 2.0 / 9, c_weights = 5.0 / 3, c_midpoint_weights = 4.0 / 3;

/// The greatest difference in colour steps, in any channel, between the quadratic and the radiance of these
/// lights anywhere on the triangle; proved, up to rounding. It uses the surface at the samples, with
/// inverse_w and normal_length, and not the radiance. Infinite if setup would clamp a sample.
///
/// Proof. On the screen, the vectors N, L and V before they are normalized are linear in barycentric
/// coordinates b, times a common factor. A unit vector u = n/|n| with linear n turns along a line by the
/// angle theta, with theta' = c/|n|^2 and a constant c = |n x n'|. Let W and R bound theta' and |n.n'|/|n|^2
/// along the edges. Then |theta''| <= 2 W R and theta''' is from -2 W^3 to 6 W R^2. The part of u'' along u
/// is at most W^2, that of u''' at most 6 W^2 R, and the part of u''' across u at most W max(6 R^2, 3 W^2).
/// Sums and products of these bounds give the first three derivatives of N.L, N.H, their powers and a spot's
/// share. A quadratic through six samples reproduces quadratics. So its error at x is the sum of the Taylor
/// remainders about any y, of the function at x and at the samples, weighted by 1 and by the weights of the
/// samples. Where a function has a jump, its range bounds the error.
double proved_bound(const Scene& scene, std::span<const Light> lights, const Material& material,
                    const SampledTriangle& triangle);

}  // namespace halfway

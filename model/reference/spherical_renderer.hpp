// SPDX-License-Identifier: Apache-2.0
// The spherical paper's interpolation per pixel in double, without tables and word lengths. Shows the error
// of the method itself and of its variants.
#pragma once

#include <span>

#include "projection/screen_triangle.hpp"
#include "reference/renderer.hpp"
#include "scene/scene.hpp"
#include "shading/arc.hpp"

namespace halfway {

/// Computation of the angle between two vectors that both turn along a span (spherical paper, section 3.2).
/// In the built-in scenes at 320x240 the frames of both schemes differ by at most one step of 255 (rms 0.03
/// to 0.27). If the vectors turn far along a span, one_fixed is worse: on a sphere of 36 triangles close to a
/// light the schemes differ by up to 26 steps, and their rms errors are 5.7 and 2.5.
enum class VectorScheme {
  one_fixed,         ///< one cosine: the second vector fixed at the span's start
  both_interpolated  ///< spherical interpolation of each vector, and their product, at each pixel
};

/// The function used for cos^n of the angle x between N and H, or R and V.
enum class HighlightCurve {
  power,          ///< cos^n itself
  squared_cosine  ///< cos^2 ax if |ax| < pi/2, zero outside; a = published_scale(n)
};

struct SphericalMethod {
  VectorScheme vectors = VectorScheme::one_fixed;
  SpanEnds ends = SpanEnds::on_surface;
  HighlightCurve curve = HighlightCurve::power;
};

/// Per light of a span: N.L from N and L, the highlight from N and H (Blinn) or R and V (Phong), each
/// interpolated between the span's two ends in the frame; zero if N.L <= 0. Cook-Torrance's highlight is not
/// a power of a cosine: it is shaded from N, L and V, each interpolated separately, in both schemes. A light
/// whose L or H is undefined at one end contributes no N.L or no highlight on the whole span. The factor of a
/// spot light's cone is linear from end to end. Coverage and depth are those of render_reference.
ReferenceImage render_spherical(const Scene& scene, std::span<const ScreenTriangle> triangles,
                                const RenderOptions& options, const SphericalMethod& method);

}  // namespace halfway

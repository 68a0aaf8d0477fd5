// SPDX-License-Identifier: Apache-2.0
// The spherical paper's interpolation pixel by pixel in double: no tables, no word lengths. Shows what the
// method itself costs in accuracy, and what its choices matter.
#pragma once

#include <span>

#include "reference/renderer.hpp"
#include "scene/scene.hpp"
#include "setup/screen_triangle.hpp"
#include "setup/setup.hpp"

namespace halfway {

/// How the angle between two vectors that both turn along a span is had (spherical paper, section 3.2). In
/// the built-in scenes at 320x240 the two give the same frame but for one step of 255 (rms 0.03 to 0.27).
/// Where the vectors turn far along a span, one_fixed is the worse: on a sphere of 36 triangles close to a
/// light they are up to 26 steps apart, and their rms errors are 5.7 and 2.5.
enum class VectorScheme {
  one_fixed,         ///< one cosine: the second held at the span's begin, the first's end turned back
  both_interpolated  ///< spherical interpolation of each, and their product, at each pixel
};

/// What stands for cos^n of the angle x between N and H, or R and V.
enum class HighlightCurve {
  power,          ///< itself
  squared_cosine  ///< cos^2 ax where |ax| < pi/2, zero outside; a = published_scale(n)
};

struct SphericalMethod {
  VectorScheme vectors = VectorScheme::one_fixed;
  SpanEnds ends = SpanEnds::on_surface;
  HighlightCurve curve = HighlightCurve::power;
};

/// Per light of a span: N.L from N and L, the highlight from N and H (Blinn) or R and V (Phong), each
/// interpolated between the span's two ends in the frame; nothing where N.L <= 0. Cook-Torrance's highlight
/// is no power of a cosine: it is shaded from N, L and V, each interpolated by itself, in both schemes. A
/// light whose L or H is undefined at one end gives no N.L or no highlight on the whole span. A spot light's
/// cone goes linearly from end to end. Coverage and depth are render_reference's.
ReferenceImage render_spherical(const Scene& scene, std::span<const ScreenTriangle> triangles,
                                const RenderOptions& options, const SphericalMethod& method);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// Reference pictures for the accuracy of a shader: Phong shading per pixel and Gouraud shading, both in
// double with exact coverage.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/host.hpp"
#include "frame/frame.hpp"
#include "frame/tile.hpp"
#include "projection/screen_triangle.hpp"
#include "scene/scene.hpp"

namespace halfway {

struct ReferenceImage {
  Frame frame;                     ///< of the whole frame or of the tile
  std::vector<std::uint8_t> mask;  ///< one byte per pixel: 1 if a triangle covers it, else 0
};

struct RenderOptions {
  FrameSize frame;
  int subpixel_bits = 4;       ///< of the screen triangles' coordinates, 1 to 9
  Workers workers{};           ///< The picture does not depend on it.
  std::optional<Tile> tile{};  ///< a part of the frame; empty: the whole frame
};

/// Normal and position are interpolated perspective-correctly at the pixel's centre and shaded there. Of two
/// triangles at the same depth the first in the span is visible. With Scene::shadows a light counts only if
/// its shadow ray reaches the point (ray_cast.hpp).
ReferenceImage render_reference(const Scene& scene, std::span<const ScreenTriangle> triangles,
                                const RenderOptions& options);

/// Each pixel is the weighted sum of 2x2 pixels: itself, left, above, above left. A pixel of these is the
/// mean of 4x4 samples, each as a pixel of render_reference and at most white; without a triangle, and
/// outside the frame, it is background. `triangles` are those of options.frame. The mask is 1 where a sample
/// is covered. Whole frames only.
ReferenceImage render_filtered(const Scene& scene, std::span<const ScreenTriangle> triangles,
                               const RenderOptions& options, const std::array<std::int64_t, 4>& weights);

/// Shades at the vertices, without clamping, and interpolates linearly on the screen. The coverage is the
/// same. Without shadows.
ReferenceImage render_gouraud(const Scene& scene, std::span<const ScreenTriangle> triangles,
                              const RenderOptions& options);

}  // namespace halfway

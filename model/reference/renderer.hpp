// SPDX-License-Identifier: Apache-2.0
// Pictures to measure a shader by: Phong shading per pixel, and Gouraud's, both in double with exact
// coverage.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "frame/frame.hpp"
#include "frame/tile.hpp"
#include "scene/scene.hpp"
#include "setup/screen_triangle.hpp"

namespace halfway {

struct ReferenceImage {
  Frame frame;                     ///< or its tile
  std::vector<std::uint8_t> mask;  ///< 1 where a triangle covers the pixel, else 0; one byte a pixel
};

/// Calls `work` at most `most` times, perhaps at the same time on several threads, and returns after the last
/// call.
using Workers = std::function<void(unsigned most, const std::function<void()>& work)>;

struct RenderOptions {
  FrameSize frame;
  int subpixel_bits = 4;       ///< of the screen triangles' coordinates, 1 to 9
  Workers workers{};           ///< none: this thread alone. The picture does not depend on it.
  std::optional<Tile> tile{};  ///< of the frame, in place of all of it
};

/// Normal and position are interpolated perspective-correctly at the pixel's centre and shaded there.
/// Of two triangles at the same depth the first in the span keeps the pixel. With Scene::shadows a light
/// counts only where its shadow ray reaches (ray_cast.hpp).
ReferenceImage render_reference(const Scene& scene, std::span<const ScreenTriangle> triangles,
                                const RenderOptions& options);

/// Shades at the vertices, unclamped, and interpolates linearly on the screen; the same coverage. It knows no
/// shadows.
ReferenceImage render_gouraud(const Scene& scene, std::span<const ScreenTriangle> triangles,
                              const RenderOptions& options);

}  // namespace halfway

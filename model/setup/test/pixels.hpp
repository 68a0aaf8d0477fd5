// SPDX-License-Identifier: Apache-2.0
// For tests: the pixels that triangles on the screen cover, and those that were drawn.
#pragma once

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

#include "frame/fragment.hpp"
#include "projection/edge.hpp"
#include "projection/project.hpp"
#include "setup/walk_header.hpp"

namespace halfway {

inline constexpr int c_subpixel_bits = 4;

using Pixels = std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>>;  // triangle, y, x

/// Calls found(x, y) for each pixel of the frame that the triangle covers.
template <class Found>
void for_each_pixel(const ScreenTriangle& triangle, FrameSize frame, Found&& found) {
  for_each_span(screen_points(triangle), c_subpixel_bits, frame,
                [&](std::uint32_t y, std::uint32_t begin, std::uint32_t end) {
                  for (std::uint32_t x = begin; x < end; ++x) found(x, y);
                });
}

inline std::vector<ScreenTriangle> projected(const Scene& scene, FrameSize frame) {
  return Projector(scene, frame, {.subpixel_bits = c_subpixel_bits}).project_all();
}

inline Pixels covered(const std::vector<ScreenTriangle>& triangles, FrameSize frame) {
  Pixels pixels;
  for (const ScreenTriangle& t : triangles)
    for_each_pixel(t, frame, [&](std::uint32_t x, std::uint32_t y) { pixels.emplace_back(t.source, y, x); });
  std::ranges::sort(pixels);
  return pixels;
}

inline Pixels drawn_pixels(const std::vector<Fragment>& fragments) {
  Pixels pixels;
  for (const Fragment& f : fragments) pixels.emplace_back(f.triangle, f.y, f.x);
  std::ranges::sort(pixels);
  return pixels;
}

}  // namespace halfway

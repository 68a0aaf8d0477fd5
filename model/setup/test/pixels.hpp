// SPDX-License-Identifier: Apache-2.0
// For tests: triangles on the screen, and the pixels that they cover.
#pragma once

#include <cstdint>
#include <vector>

#include "projection/edge.hpp"
#include "projection/project.hpp"
#include "setup/walk_header.hpp"

namespace halfway {

inline constexpr int c_subpixel_bits = 4;

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

}  // namespace halfway

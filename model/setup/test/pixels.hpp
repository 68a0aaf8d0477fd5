// SPDX-License-Identifier: Apache-2.0
// For tests: triangles on the screen of preset exact.
#pragma once

#include <vector>

#include "projection/project.hpp"

namespace halfway {

inline constexpr int c_subpixel_bits = 4;

inline std::vector<ScreenTriangle> projected(const Scene& scene, FrameSize frame) {
  return Projector(scene, frame, {.subpixel_bits = c_subpixel_bits}).project_all();
}

}  // namespace halfway

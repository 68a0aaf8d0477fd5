// SPDX-License-Identifier: Apache-2.0
// Mach bands: a jump in the slope of brightness between two triangles looks like an edge.
#pragma once

#include <cstdint>
#include <span>

#include "frame/frame.hpp"
#include "projection/screen_triangle.hpp"
#include "scene/scene.hpp"

namespace halfway::study {

/// Jumps of the slope across edges minus the reference's jumps at the same edges, in colour steps per pixel.
struct MachBands {
  std::uint64_t edges = 0;  ///< edges evaluated
  double rms = 0.0, largest = 0.0;
};

/// Evaluate every edge where the surface is smooth and both triangles are visible. On each side of the edge,
/// fit a plane to the brightness (the mean of the three channels) of the pixels at most 4 pixels away. The
/// frames must have the same size. `triangles` are the scene's triangles at this size, with 4 subpixel bits.
MachBands mach_bands(const Frame& frame, const Frame& reference, const Scene& scene,
                     std::span<const ScreenTriangle> triangles);

}  // namespace halfway::study

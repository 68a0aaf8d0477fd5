// SPDX-License-Identifier: Apache-2.0
// Mach bands: the eye sees an edge between two triangles where the brightness's slope across it jumps.
#pragma once

#include <cstdint>
#include <span>

#include "common/result.hpp"
#include "frame/frame.hpp"
#include "scene/scene.hpp"
#include "setup/screen_triangle.hpp"

namespace halfway::study {

/// Of the jumps of the slope across edges, less the reference's at the same edge; in colour steps a pixel.
struct MachBands {
  std::uint64_t edges = 0;  ///< looked at
  double rms = 0.0, largest = 0.0;
};

/// Looks at every edge over which the surface is smooth and both triangles are seen: on either side a plane
/// is fitted to the brightness (the mean of the three channels) of the pixels at most 4 pixels from the edge.
/// The frames' sizes must agree; `triangles` are those of the scene at this size, with 4 subpixel bits.
Result<MachBands> mach_bands(const Frame& frame, const Frame& reference, const Scene& scene,
                             std::span<const ScreenTriangle> triangles);

}  // namespace halfway::study

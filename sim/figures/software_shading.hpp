// SPDX-License-Identifier: Apache-2.0
// The three renderers that the quadratic paper compares, as plain software. They share one scan conversion.
// Per pixel and channel they compute one addition, two additions, or the illumination model.
#pragma once

#include <span>

#include "frame/frame.hpp"
#include "projection/screen_triangle.hpp"
#include "scene/scene.hpp"

namespace halfway::figures {

enum class SoftwareShading {
  gouraud,    ///< shaded at the three vertices, linear in between
  quadratic,  ///< shaded at six points, with forward differences
  phong       ///< shaded at each pixel; normal and position are linear on the screen, as in the paper
};

struct SoftwareFrame {
  Frame frame;
  double seconds;  ///< processor seconds for drawing the triangles into an existing frame
};

/// Computed in double with a depth buffer, from triangles with 4 subpixel bits, on the calling thread.
SoftwareFrame shade_in_software(const Scene& scene, std::span<const ScreenTriangle> triangles, FrameSize size,
                                SoftwareShading shading);

}  // namespace halfway::figures

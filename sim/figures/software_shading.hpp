// SPDX-License-Identifier: Apache-2.0
// The three renderers whose times the quadratic paper compares, as plain software: one scan conversion, and
// per pixel an addition a channel, two, or the illumination model.
#pragma once

#include <span>

#include "frame/frame.hpp"
#include "scene/scene.hpp"
#include "setup/screen_triangle.hpp"

namespace halfway::figures {

enum class SoftwareShading {
  gouraud,    ///< shaded at the three vertices, linear between
  quadratic,  ///< at six points, by forward differences
  phong       ///< at each pixel; normal and position linear on the screen, as the paper has them
};

struct SoftwareFrame {
  Frame frame;
  double seconds;  ///< of the processor, to draw the triangles on a frame that is there
};

/// In double, with a depth buffer, of triangles at 4 subpixel bits; on this thread.
SoftwareFrame shade_in_software(const Scene& scene, std::span<const ScreenTriangle> triangles, FrameSize size,
                                SoftwareShading shading);

}  // namespace halfway::figures

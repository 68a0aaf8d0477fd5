// SPDX-License-Identifier: Apache-2.0
// Setup of the shading processors: lights as definitions, then triangles as planes of what the processors
// take for each pixel, and their materials. All in view space: the eye at the origin, looking along -z.
//
// What is linear on the screen, and so comes to a pixel as it is:
//   exact      N/w, scaled by triangle; the view ray, a point over its w, scaled by b; and a/w. Of a triangle
//   that
//              has one normal, that normal, unit.
//   published  unit N and P, as if they were; P and the lights' places over one scale
// where w is the distance along the viewing axis, and a, b and the scale are powers of two, one a frame.
//
// With shadows the stream goes by lines, so that a pixel's surface is known before shadow polygons pass over
// it: for each line all triangles for their depths, then all polygons, then all triangles to be shaded. A
// triangle's part of a line starts from sums of its whole walk's words: each pixel is what it is without.
#pragma once

#include <memory>

#include "plan/hardware_key.hpp"
#include "setup/setup.hpp"

namespace halfway {

/// The scene must outlive the setup.
std::unique_ptr<Setup> make_processors_setup(const Scene& scene, FrameSize frame, const HardwareKey& key,
                                             const ProcessorsSetupOptions& options = {});

}  // namespace halfway

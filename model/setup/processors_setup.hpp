// SPDX-License-Identifier: Apache-2.0
// Setup of the shading processors. It sends the definitions of the lights first, then the triangles with
// their materials, as planes of the processors' per-pixel inputs. All in view space: the eye is at the origin
// and looks along -z.
//
// The per-pixel inputs are linear on the screen:
//   exact      N/w, scaled per triangle; the view ray, a point divided by its w, scaled by b; and a/w. A
//              triangle with one normal uses that normal as a unit vector.
//   published  unit N and P, although they are not linear; P and the places of lights have one common scale.
// w is the distance along the viewing axis. a, b and the scale are powers of two, one per frame.
//
// For object processors the stream is ordered by strips of the frame (object_strips.hpp), each with its
// triangles and shadow polygons in the order of their first lines.
#pragma once

#include <memory>

#include "plan/hardware_key.hpp"
#include "setup/setup.hpp"

namespace halfway {

/// The scene must outlive the setup.
std::unique_ptr<Setup> make_processors_setup(const Scene& scene, FrameSize frame, const HardwareKey& key,
                                             const ProcessorsSetupOptions& options = {});

}  // namespace halfway

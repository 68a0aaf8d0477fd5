// SPDX-License-Identifier: Apache-2.0
// A camera that turns around the scene.
#pragma once

#include <cstdint>

#include "scene/scene.hpp"

namespace halfway {

/// The camera after step `frame` of `frames` steps of one turn around its target. The axis is `up_world`, the
/// direction is counter-clockwise seen from above. Frame 0 is bit-identical to the given camera.
Camera turned(const Camera& camera, std::uint32_t frame, std::uint32_t frames);

/// The greatest approach of `orbited` to the axis.
inline constexpr double c_least_pole_degrees = 1.0;

/// The camera after a turn of `azimuth_degrees` as in `turned`, then of `elevation_degrees` towards
/// `up_world`, around its target, at its distance times a factor. A turn towards the axis ends
/// c_least_pole_degrees before it. With 0, 0 and 1 it is bit-identical to the given camera.
Camera orbited(const Camera& camera, double azimuth_degrees, double elevation_degrees,
               double distance_factor);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// A camera that turns around the scene.
#pragma once

#include <cstdint>

#include "scene/scene.hpp"

namespace halfway {

/// The camera after step `frame` of `frames` steps of one turn around its target. The axis is `up_world`, the
/// direction is counter-clockwise seen from above. Frame 0 is bit-identical to the given camera.
Camera turned(const Camera& camera, std::uint32_t frame, std::uint32_t frames);

}  // namespace halfway

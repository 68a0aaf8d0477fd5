// SPDX-License-Identifier: Apache-2.0
// The camera's way around a scene.
#pragma once

#include <cstdint>

#include "scene/scene.hpp"

namespace halfway {

/// The camera after `frame` of `frames` steps of one turn around its target, about `up_world` and
/// counter-clockwise seen from above. Frame 0 is the camera itself, to the last bit.
Camera turned(const Camera& camera, std::uint32_t frame, std::uint32_t frames);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// When a simulation has gone astray.
#pragma once

#include <cstdint>

#include "frame/frame.hpp"

namespace halfway {

/// Cycles without a movement after which the hardware hangs: more than all lines of a frame, empty.
inline constexpr std::uint32_t c_idle_limit = 4 * c_max_frame_side;
/// Fragments past the golden model's after which a runaway is stopped.
inline constexpr std::uint64_t c_most_surplus = 10'000;

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// Limits after which a simulation is stopped as faulty.
#pragma once

#include <cstdint>

#include "frame/frame.hpp"

namespace halfway {

/// Number of cycles without progress that counts as a hang. It exceeds the time for all lines of an empty
/// frame.
inline constexpr std::uint32_t c_idle_limit = 4 * c_max_frame_side;
/// Number of fragments beyond the golden model's after which a simulation is stopped.
inline constexpr std::uint64_t c_most_surplus = 10'000;

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// Limits after which a simulation is stopped as faulty.
#pragma once

#include <cstdint>

#include "frame/frame.hpp"
#include "plan/hardware_key.hpp"

namespace halfway {

/// Number of cycles without progress that counts as a hang. It exceeds the time for all lines of an empty
/// frame.
inline constexpr std::uint32_t c_idle_limit = 4 * c_max_frame_side;
/// The same for the hardware of a key. Object processors also scan the pixels that slivers leave out.
inline std::uint32_t idle_limit(const HardwareKey& key) {
  return key.processors.objects > 0 ? 64 * c_idle_limit : c_idle_limit;
}
/// Number of fragments beyond the golden model's after which a simulation is stopped.
inline constexpr std::uint64_t c_most_surplus = 10'000;

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// Counts what object processors send to the shading processors.
#pragma once

#include <cstdint>
#include <span>

#include "plan/hardware_key.hpp"

namespace halfway {

/// The objects that are shaded for these vectors of whole strips. The key must have object processors.
std::uint64_t count_objects(const HardwareKey& key, std::span<const std::uint32_t> init_words);

}  // namespace halfway

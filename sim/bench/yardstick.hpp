// SPDX-License-Identifier: Apache-2.0
// Work that uses vector units only. A slow-down with several threads is caused by the machine's processors
// sharing resources.
#pragma once

#include <cstdint>

namespace halfway {

/// Add vectors as wide as those of the lanes, in registers only. Return the result, so that the compiler does
/// not remove the work.
std::uint32_t sum_in_registers(std::uint32_t rounds);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// Work that asks nothing of a machine but its vector units: what several threads lose at it, the machine's
// processors take from one another.
#pragma once

#include <cstdint>

namespace halfway {

/// Independent sums of vectors as wide as those of lanes, in registers alone. What they come to, so that
/// nobody leaves them out.
std::uint32_t sum_in_registers(std::uint32_t rounds);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/arithmetic/multiplier.vhd.
#pragma once

#include <cstdint>

namespace halfway::golden {

/// Unsigned, exact.
constexpr std::uint64_t multiply(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{a} * b;
}

}  // namespace halfway::golden

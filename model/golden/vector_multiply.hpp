// SPDX-License-Identifier: Apache-2.0
// Twin of rtl/arithmetic/vector_multiply.vhd, and what is made of its products.
#pragma once

#include "golden/vector_shift.hpp"

namespace halfway::golden {

/// Each component of a times the one of b, exact.
constexpr Axes vector_multiply(const Axes& a, const Axes& b) {
  return {a[0] * b[0], a[1] * b[1], a[2] * b[2]};
}
constexpr Axes vector_multiply(const Axes& a, std::int64_t factor) {
  return vector_multiply(a, Axes{factor, factor, factor});
}

/// Without the lowest `bits` bits, to the nearest, halves up.
constexpr std::int64_t round_half_up(std::int64_t value, int bits) {
  return bits == 0 ? value : (value + (std::int64_t{1} << (bits - 1))) >> bits;
}

}  // namespace halfway::golden

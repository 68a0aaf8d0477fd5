// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/arithmetic/vector_multiply.vhd, and rounding of its products.
#pragma once

#include "golden/vector_shift.hpp"

namespace halfway::golden {

/// Exact products of the components of a and b.
constexpr Axes vector_multiply(const Axes& a, const Axes& b) {
  return {a[0] * b[0], a[1] * b[1], a[2] * b[2]};
}
constexpr Axes vector_multiply(const Axes& a, std::int64_t factor) {
  return vector_multiply(a, Axes{factor, factor, factor});
}

/// Removes the lowest `bits` bits: rounds to nearest, halves up.
constexpr std::int64_t round_half_up(std::int64_t value, int bits) {
  return bits == 0 ? value : (value + (std::int64_t{1} << (bits - 1))) >> bits;
}

}  // namespace halfway::golden

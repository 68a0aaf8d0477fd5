// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/arithmetic/vector_shift.vhd.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "golden/words.hpp"
#include "words/processors_layout.hpp"

namespace halfway::golden {

/// x, y and z of a vector.
using Axes = std::array<std::int64_t, c_axes>;

/// Shifts the three components (VectorBits bits) left by the same number of bits, the greatest without
/// overflow of the sign. The results have ResultBits bits, all fraction except the sign: the largest is then
/// from 1/2 to 1. Bits below the format are truncated. A zero vector stays zero.
template <int VectorBits, int ResultBits>
constexpr Axes vector_shift(const Axes& v) {
  static_assert(VectorBits >= 2 && VectorBits < 64 && ResultBits < 64);
  std::uint64_t moving = 0;  // bit set: some component differs from its sign at this bit
  for (const std::int64_t component : v) moving |= static_cast<std::uint64_t>(component ^ (component >> 63));
  const int free = VectorBits - 1 - static_cast<int>(std::bit_width(moving));
  Axes shifted;
  for (std::size_t axis = 0; axis < v.size(); ++axis) {
    const std::int64_t whole = v[axis] << free;
    if constexpr (VectorBits >= ResultBits)
      shifted[axis] = whole >> (VectorBits - ResultBits);
    else
      shifted[axis] = whole << (ResultBits - VectorBits);
  }
  return shifted;
}

}  // namespace halfway::golden

// SPDX-License-Identifier: Apache-2.0
// Twin of rtl/arithmetic/vector_shift.vhd.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "golden/formats.hpp"
#include "golden/processors_layout.hpp"

namespace halfway::golden {

/// X, y and z of a vector.
using Axes = std::array<std::int64_t, c_axes>;

/// The three components of VectorBits bits each, shifted left alike as far as none loses its sign, in
/// ResultBits of which all but the sign are fraction: the largest then lies from 1/2 to 1. What does not fit
/// is dropped below. A zero vector stays one.
template <int VectorBits, int ResultBits>
constexpr Axes vector_shift(const Axes& v) {
  static_assert(VectorBits >= 2 && VectorBits < 64 && ResultBits < 64);
  std::uint64_t moving = 0;  // a bit set: there some component differs from its sign
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

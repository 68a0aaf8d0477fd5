// SPDX-License-Identifier: Apache-2.0
// Operations of the generated lanes that are built from those of the vector type, for any processor.
#pragma once

#include <cstdint>
#include <cstring>

#include "sim/lanes/lane_vector.hpp"

namespace halfway::lanes {

LANE_FUNCTION V left_by(V a, V distance) {
  return select(less(distance, splat(32)), a << (distance & 31), V{});
}
LANE_FUNCTION V right_by(V a, V distance) {
  return select(less(distance, splat(32)), a >> (distance & 31), V{});
}
LANE_FUNCTION V signed_right_by(V a, V distance) {
  return (V)((S)a >> (S)select(less(distance, splat(31)), distance, splat(31)));
}
LANE_FUNCTION V multiply_high(V a, V b) {  // the product's upper word
  const V al = a & 0xffff, ah = a >> 16, bl = b & 0xffff, bh = b >> 16;
  const V low = al * bl, left = ah * bl + (low >> 16), right = al * bh + (left & 0xffff);
  return ah * bh + (left >> 16) + (right >> 16);
}

/// A memory: each lane's places are adjacent, followed by one place for lanes that write nothing.
template <unsigned places>
struct Memory {
  alignas(64) std::uint32_t of[c_lanes][places + 1][4]{};
};
template <unsigned places>
LANE_FUNCTION void store(Memory<places>& memory, M mask, V address, const Row& row) {
  Row turned = turn(row);
  const V where = select(mask, address, splat(places));
  for (unsigned i = 0; i < c_lanes; ++i) std::memcpy(memory.of[i][where[i]], of_lane(turned, i), 16);
}
template <unsigned places>
LANE_FUNCTION Row load(const Memory<places>& memory, V address) {
  Row turned;
  for (unsigned i = 0; i < c_lanes; ++i) std::memcpy(of_lane(turned, i), memory.of[i][address[i]], 16);
  return turn(turned);
}

/// `width` bits, 32 at most, of an array of words from bit `low` up; reads no word but those they lie in.
template <unsigned low, unsigned width>
LANE_FUNCTION std::uint32_t field(const std::uint32_t* words) {
  constexpr unsigned first = low / 32, shift = low % 32;
  std::uint64_t value = words[first];
  if constexpr (shift + width > 32) value |= static_cast<std::uint64_t>(words[first + 1]) << 32;
  return static_cast<std::uint32_t>(value >> shift & ((std::uint64_t{1} << width) - 1));
}

}  // namespace halfway::lanes

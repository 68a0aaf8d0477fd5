// SPDX-License-Identifier: Apache-2.0
// Operations of the generated lanes that are built from those of the vector type, for any processor.
#pragma once

#include <cstdint>
#include <cstring>

#include "sim/extras/lanes/lane_vector.hpp"

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
/// The upper words of the products of every second lane, from the first or from the second one on.
template <class Double>
LANE_FUNCTION V upper_words(Double even, Double odd) {
  return (V)((W)even >> 32) | ((V)odd & (V)(W{} + (std::uint64_t{0xffffffff} << 32)));
}
LANE_FUNCTION V multiply_high(V a, V b) {
  const W low = W{} + 0xffffffff, x = (W)a, y = (W)b;
  return upper_words((x & low) * (y & low), (x >> 32) * (y >> 32));
}
LANE_FUNCTION V signed_multiply_high(V a, V b) {
  const D x = (D)a, y = (D)b;
  return upper_words((x << 32 >> 32) * (y << 32 >> 32), (x >> 32) * (y >> 32));
}

/// A register of the hardware, or a field of one, and its variable in the generated State.
struct Register {
  const char* name;  ///< path of instances, signal and field
  unsigned bits;
  bool mask;  ///< the variable is an M, otherwise a V
  std::size_t offset;
};

/// The values of registers that only delay others, in all lanes at once: one place for each clock.
template <class Place, unsigned places>
struct Ring {
  Place of[places]{};
  unsigned clock = 0;
  Place& next() { return of[(clock + 1) % places]; }
  Place& late(unsigned age) { return of[(clock - age) % places]; }
  const Place& late(unsigned age) const { return of[(clock - age) % places]; }
};
/// Copy the values of these lanes to the next younger place, and so undo a move.
template <class Place, unsigned places>
__attribute__((noinline)) void undo(Ring<Place, places>& ring, M lanes) {
  for (unsigned age = 0; age + 1 < places; ++age) {
    V* const to = reinterpret_cast<V*>(&ring.late(age));
    const V* const from = reinterpret_cast<V*>(&ring.late(age + 1));
    for (std::size_t i = 0; i < sizeof(Place) / sizeof(V); ++i) assign(lanes, to[i], from[i]);
  }
}
/// Move the values of these lanes by a clock.
template <class Place, unsigned places>
LANE_FUNCTION void advance(Ring<Place, places>& ring, M lanes) {
  if (!any(lanes)) return;
  ++ring.clock;
  const M others = invert(lanes);
  if (any(others)) undo(ring, others);
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
  constexpr unsigned c_first = low / 32, c_shift = low % 32;
  std::uint64_t value = words[c_first];
  if constexpr (c_shift + width > 32) value |= static_cast<std::uint64_t>(words[c_first + 1]) << 32;
  return static_cast<std::uint32_t>(value >> c_shift & ((std::uint64_t{1} << width) - 1));
}

}  // namespace halfway::lanes

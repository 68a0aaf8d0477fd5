// SPDX-License-Identifier: Apache-2.0
// Functions of directions, composed of the golden models of the entities: normalized vectors, and cosines
// between them.
#pragma once

#include <algorithm>

#include "golden/dot_product.hpp"
#include "golden/reciprocal_root.hpp"
#include "golden/vector_multiply.hpp"
#include "golden/vector_shift.hpp"

namespace halfway::golden {

/// The unit vector in the direction of v, in format direction. The components of v have VectorBits bits and
/// any common scale. A zero vector gives a zero vector.
template <class Preset, int VectorBits>
constexpr Axes normalized(const Axes& v) {
  constexpr int c_bits = Preset::c_direction_bits;
  const Axes u = vector_shift<VectorBits, c_bits>(v);  // c_bits - 1 bits of fraction
  const auto square =
      static_cast<std::uint32_t>(dot_product(u, u) >> (2 * (c_bits - 1) - Preset::c_square_fraction_bits));
  Axes unit = vector_multiply(u, ReciprocalRoot<Preset>::reciprocal(square));
  for (std::int64_t& component : unit)
    component = round_half_up(
        component, c_bits - 1 + ReciprocalRoot<Preset>::c_fraction_bits - Preset::c_direction_fraction_bits);
  return unit;
}

/// For a dot product of directions: true if light comes from that side.
constexpr bool positive(std::int64_t dot) {
  return dot > 0;
}

/// A dot product of directions as a cosine from 0 to 1, with a direction's fraction bits.
template <class Preset>
constexpr std::uint32_t cosine(std::int64_t dot) {
  constexpr int c_fraction = Preset::c_direction_fraction_bits;
  if (!positive(dot)) return 0;
  return static_cast<std::uint32_t>(std::min(round_half_up(dot, c_fraction), std::int64_t{1} << c_fraction));
}

}  // namespace halfway::golden

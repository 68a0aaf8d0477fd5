// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/illumination/half_vector.vhd.
#pragma once

#include <cstddef>
#include <cstdint>

#include "golden/unit_vector.hpp"
#include "golden/words.hpp"

namespace halfway::golden {

/// Bits of the sum: of two directions (exact), or of a direction and an offset (published, as printed).
template <class Preset>
inline constexpr int c_half_sum_bits =
    Preset::c_light_shift_bits > 0 ? Preset::c_direction_bits + 1 : Preset::c_offset_bits;

/// H: the unit vector in the direction of `to_light` plus `to_eye`. Preset exact: L and V. Preset published:
/// the vector to the light, not normalized, and E.
template <class Preset>
constexpr Axes half_vector(const Axes& to_light, const Axes& to_eye) {
  using Sum = Word<c_half_sum_bits<Preset>>;
  Axes sum{};
  for (std::size_t i = 0; i < sum.size(); ++i)
    sum[i] = Sum::from_bits(static_cast<std::uint64_t>(to_light[i] + to_eye[i])).value();
  return normalized<Preset, c_half_sum_bits<Preset>>(sum);
}

}  // namespace halfway::golden

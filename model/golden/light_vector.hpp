// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/illumination/light_vector.vhd.
#pragma once

#include <cstddef>
#include <cstdint>

#include "golden/unit_vector.hpp"
#include "golden/words.hpp"

namespace halfway::golden {

/// The vector from a point to a light, in format offset. Preset exact: `place` times `distance`, minus
/// `point` shifted right.
template <class Preset>
constexpr Axes light_offset(const Axes& place, std::uint32_t shift, const Axes& point,
                            std::int64_t distance) {
  using Offset = Word<Preset::c_offset_bits>;
  Axes offset{};
  for (std::size_t i = 0; i < offset.size(); ++i) {
    std::int64_t from_eye = place[i];
    if constexpr (Preset::c_light_shift_bits > 0)
      from_eye = round_half_up(from_eye * distance, Preset::c_light_place_fraction_bits +
                                                        Preset::c_vector_fraction_bits -
                                                        Preset::c_offset_fraction_bits);
    offset[i] = Offset::from_bits(static_cast<std::uint64_t>(from_eye - (point[i] >> shift))).value();
  }
  return offset;
}

/// L. For a directional light it is the direction in `place`.
template <class Preset>
constexpr Axes light_vector(bool positional, const Axes& place, std::uint32_t shift, const Axes& point,
                            std::int64_t distance) {
  if (positional)
    return normalized<Preset, Preset::c_offset_bits>(light_offset<Preset>(place, shift, point, distance));
  Axes direction{};
  for (std::size_t i = 0; i < direction.size(); ++i)
    direction[i] = place[i] >> (Preset::c_light_place_fraction_bits - Preset::c_direction_fraction_bits);
  return direction;
}

}  // namespace halfway::golden

// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/arithmetic/angle_address.vhd.
#pragma once

#include <type_traits>

#include "golden/words.hpp"
#include "words/generator/cosine_size.hpp"

namespace halfway::golden {

/// The cell of an angle in a cosine table. in_range: the angle is within the bell.
struct AngleAddress {
  std::uint32_t address;
  bool in_range;
};

template <class Preset>
constexpr AngleAddress angle_address(Word<Preset::c_angle_bits> angle, const words::CosineSize& table) {
  if constexpr (std::is_same_v<Preset, Exact>) {
    constexpr int c_fraction = Preset::c_angle_fraction_bits;
    const std::int64_t sign = angle.value() >> 63;
    // Use the ones' complement for negative angles: v and -1 - v then have the same cell.
    const auto magnitude = static_cast<std::uint64_t>(angle.value() ^ sign);
    return {static_cast<std::uint32_t>(low_bits(magnitude, c_fraction) >> (c_fraction - table.address_bits)),
            magnitude >> c_fraction == 0};
  } else {
    return {static_cast<std::uint32_t>(angle.bits() >> (Preset::c_angle_bits - table.address_bits)), true};
  }
}

}  // namespace halfway::golden

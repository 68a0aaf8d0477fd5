// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/illumination/radiance_sum.vhd.
#pragma once

#include <algorithm>
#include <cstdint>

#include "golden/words.hpp"

namespace halfway::golden {

/// I_in plus the term of one channel, limited to the largest value.
template <class Preset>
constexpr std::uint32_t radiance_sum(std::uint32_t radiance, std::uint64_t term) {
  constexpr std::uint64_t c_largest = low_bits(~std::uint64_t{0}, Preset::c_radiance_bits);
  constexpr int c_drop =
      Preset::c_reflected_fraction_bits + Preset::c_weight_fraction_bits - Preset::c_radiance_fraction_bits;
  return static_cast<std::uint32_t>(std::min(radiance + (term >> c_drop), c_largest));
}

}  // namespace halfway::golden

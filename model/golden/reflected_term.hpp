// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/illumination/reflected_term.vhd.
#pragma once

#include <algorithm>
#include <cstdint>

#include "golden/vector_multiply.hpp"
#include "golden/words.hpp"

namespace halfway::golden {

/// k I weight of one channel, with the fraction bits of reflected and weight.
template <class Preset>
constexpr std::uint64_t reflected_term(std::uint32_t k, std::uint32_t intensity, std::uint32_t weight) {
  constexpr std::uint64_t c_largest = low_bits(~std::uint64_t{0}, Preset::c_reflected_bits);
  constexpr int c_drop = Preset::c_coefficient_fraction_bits + Preset::c_light_intensity_fraction_bits -
                         Preset::c_reflected_fraction_bits;
  const std::int64_t product = std::int64_t{k} * intensity;
  return std::min(static_cast<std::uint64_t>(round_half_up(product, c_drop)), c_largest) * weight;
}

/// The weight of an ambient term, which is 1.
template <class Preset>
inline constexpr std::uint32_t c_full_weight = 1U << Preset::c_weight_fraction_bits;

}  // namespace halfway::golden

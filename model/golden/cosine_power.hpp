// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/illumination/cosine_power.vhd.
#pragma once

#include <cstdint>

#include "golden/power.hpp"
#include "golden/unit_vector.hpp"

namespace halfway::golden {

/// N.A of a diffuse term, in format weight.
template <class Preset>
constexpr std::uint32_t cosine_weight(const Axes& normal, const Axes& direction) {
  constexpr int c_drop = Preset::c_direction_fraction_bits - Preset::c_weight_fraction_bits;
  return static_cast<std::uint32_t>(round_half_up(cosine<Preset>(dot_product(normal, direction)), c_drop));
}

/// (N.A)^x, in format weight.
template <class Preset>
std::uint32_t cosine_power(const Axes& normal, const Axes& direction, std::uint32_t exponent) {
  return Power<Preset>::power(cosine<Preset>(dot_product(normal, direction)), exponent);
}

}  // namespace halfway::golden

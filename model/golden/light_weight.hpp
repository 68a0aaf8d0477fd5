// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/illumination/light_weight.vhd.
#pragma once

#include <cstdint>

#include "golden/dot_product.hpp"
#include "golden/spot_cone.hpp"

namespace halfway::golden {

/// `cosine`, in format weight, times the factor of a spot's cone.
template <class Preset>
constexpr std::uint32_t light_weight(std::uint32_t cosine, const Axes& to_light, const Axes& axis,
                                     std::int64_t outer, std::uint32_t slope) {
  const std::uint32_t share = SpotCone<Preset>::factor(dot_product(to_light, axis), outer, slope);
  return static_cast<std::uint32_t>(std::uint64_t{cosine} * share >> Preset::c_weight_fraction_bits);
}

}  // namespace halfway::golden

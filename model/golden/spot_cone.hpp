// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/illumination/spot_cone.vhd.
#pragma once

#include <algorithm>

#include "golden/vector_multiply.hpp"
#include "golden/words.hpp"

namespace halfway::golden {

template <class Preset>
class SpotCone {
 public:
  /// Fraction bits of a sum of products of directions.
  static constexpr int c_sum_fraction = 2 * Preset::c_direction_fraction_bits;
  /// Fraction bits of the cosine minus the cosine of the outer edge. With a slope of 2^12 one step is one
  /// step of t. Steeper edges are as narrow as the errors of directions.
  static constexpr int c_over_fraction = 28;

  /// The light's share in format weight, from the cosine of the angle between the cone's axis and the
  /// direction from the light to the point: 0 outside the outer edge, 1 inside the inner one, t^2 (3 - 2 t)
  /// between, t linear in the cosine. axis_sum: the exact dot product of the direction *to* the light and the
  /// axis. outer: the cosine of the outer edge as a direction. slope: 1 / (inner cosine - outer), in format
  /// spot_slope.
  static constexpr std::uint32_t factor(std::int64_t axis_sum, std::int64_t outer, std::uint32_t slope) {
    const std::int64_t over = -axis_sum - (outer << Preset::c_direction_fraction_bits);
    if (over <= 0) return 0;
    const auto over_cut = static_cast<std::uint64_t>(over) >> (c_sum_fraction - c_over_fraction);
    constexpr std::uint64_t c_one = std::uint64_t{1} << Preset::c_weight_fraction_bits;
    const std::uint64_t t =
        std::min((over_cut * slope) >>
                     (c_over_fraction + Preset::c_spot_slope_fraction_bits - Preset::c_weight_fraction_bits),
                 c_one);
    return static_cast<std::uint32_t>(round_half_up(static_cast<std::int64_t>(t * t * (3 * c_one - 2 * t)),
                                                    2 * Preset::c_weight_fraction_bits));
  }
};

}  // namespace halfway::golden

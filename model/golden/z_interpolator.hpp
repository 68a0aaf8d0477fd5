// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/interpolation/z_interpolator.vhd.
#pragma once

#include <type_traits>

#include "golden/plane_interpolator.hpp"

namespace halfway::golden {

/// The same calls per clock as PlaneInterpolator.
template <class Preset>
class ZInterpolator : public PlaneInterpolator<Preset::c_depth_sum_bits> {
 public:
  using Plane = PlaneInterpolator<Preset::c_depth_sum_bits>;
  using At = typename Preset::init_header_at;

  void line_load(std::span<const std::uint32_t> init) {
    const auto word = [&](const Field& field) { return Plane::Value::from_bits(get_bits(init, field)); };
    if constexpr (std::is_same_v<Preset, Exact>)
      Plane::line_load(word(At::z), word(At::z_dx), word(At::z_de0), word(At::z_de1));
    else
      Plane::line_load(word(At::z), word(At::z_dx), word(At::z_de0), word(At::z_de0));
  }

  /// Depth of the pixel: the integer bits of the sum.
  std::uint32_t z() const {
    return static_cast<std::uint32_t>(
        low_bits(Plane::value().bits() >> Preset::c_depth_sum_fraction_bits, Preset::c_depth_bits));
  }
};

}  // namespace halfway::golden

// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/interpolation/quadratic_interpolator.vhd.
#pragma once

#include <type_traits>

#include "golden/line_interpolator.hpp"

namespace halfway::golden {

/// In one clock call line_load or line_step, and span_load or span_step: the RTL never loads and steps in the
/// same clock.
template <class Preset>
class QuadraticInterpolator {
 public:
  using Value = Word<Preset::c_intensity_bits>;
  using At = typename Preset::init_channel_at;
  static constexpr bool c_carries = std::is_same_v<Preset, Exact>;

  /// `block_low`: lowest bit of the channel's block in the init vector.
  void line_load(std::span<const std::uint32_t> init, int block_low) {
    const auto word = [&](const Field& field) { return Value::from_bits(get_bits(init, field, block_low)); };
    value_along_edge_.load(word(At::value));
    dx_along_edge_.load(word(At::dx));
    de0_along_edge_.load(word(At::de0));
    dxx_ = word(At::dxx);
    dxe0_ = word(At::dxe0);
    de0e0_ = word(At::de0e0);
    if constexpr (c_carries) {
      de1_along_edge_.load(word(At::de1));
      dxe1_ = word(At::dxe1);
      de0e1_ = word(At::de0e1);
      de1e1_ = word(At::de1e1);
    }
  }
  void line_step([[maybe_unused]] bool carry) {
    if constexpr (c_carries) {
      value_along_edge_.step(carry ? edge_de1() : edge_de0());
      dx_along_edge_.step(carry ? dxe1_ : dxe0_);
      de0_along_edge_.step(carry ? de0e1_ : de0e0_);
      de1_along_edge_.step(carry ? de1e1_ : de0e1_);
    } else {
      value_along_edge_.step(edge_de0());
      dx_along_edge_.step(dxe0_);
      de0_along_edge_.step(de0e0_);
    }
  }
  void span_load() {
    value_along_line_.load(edge_value());
    dx_along_line_.load(edge_dx());
    span_dxx_ = dxx_;
  }
  void span_step() {
    value_along_line_.step(dx());
    dx_along_line_.step(span_dxx_);
  }

  Value edge_value() const { return value_along_edge_.value(); }
  Value edge_dx() const { return dx_along_edge_.value(); }
  Value edge_de0() const { return de0_along_edge_.value(); }
  Value edge_de1() const { return de1_along_edge_.value(); }
  Value value() const { return value_along_line_.value(); }
  Value dx() const { return dx_along_line_.value(); }

 private:
  using Interpolator = LineInterpolator<Preset::c_intensity_bits>;
  Interpolator value_along_edge_, dx_along_edge_, de0_along_edge_, de1_along_edge_;
  Interpolator value_along_line_, dx_along_line_;
  Value dxx_, dxe0_, dxe1_, de0e0_, de0e1_, de1e1_, span_dxx_;
};

}  // namespace halfway::golden

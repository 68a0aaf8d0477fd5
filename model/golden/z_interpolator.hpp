// SPDX-License-Identifier: Apache-2.0
// Twin of rtl/interpolation/z_interpolator.vhd.
#pragma once

#include <type_traits>

#include "golden/line_interpolator.hpp"

namespace halfway::golden {

template <class Preset>
class ZInterpolator {
 public:
  using Value = Word<Preset::c_depth_sum_bits>;
  using At = typename Preset::init_header_at;

  void line_load(std::span<const std::uint32_t> init) {
    const auto word = [&](const Field& field) { return Value::from_bits(get_bits(init, field)); };
    along_edge_.load(word(At::z));
    dx_ = word(At::z_dx);
    de0_ = de1_ = word(At::z_de0);
    if constexpr (std::is_same_v<Preset, Exact>) de1_ = word(At::z_de1);
  }
  void line_step(bool carry) { along_edge_.step(carry ? de1_ : de0_); }
  void span_load() {
    along_line_.load(along_edge_.value());
    span_dx_ = dx_;
  }
  void span_step() { along_line_.step(span_dx_); }

  Value line_value() const { return along_edge_.value(); }
  Value value() const { return along_line_.value(); }

 private:
  LineInterpolator<Preset::c_depth_sum_bits> along_edge_, along_line_;
  Value dx_, de0_, de1_, span_dx_;
};

}  // namespace halfway::golden

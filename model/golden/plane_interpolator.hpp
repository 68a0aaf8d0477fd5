// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/interpolation/plane_interpolator.vhd.
#pragma once

#include "golden/line_interpolator.hpp"

namespace halfway::golden {

/// In one clock call line_load or line_step, and span_load or span_step: the RTL never loads and steps in the
/// same clock.
template <int W>
class PlaneInterpolator {
 public:
  using Value = Word<W>;

  /// If edges have no carry, set de1 equal to de0.
  void line_load(Value value, Value dx, Value de0, Value de1) {
    along_edge_.load(value);
    dx_ = dx;
    de0_ = de0;
    de1_ = de1;
  }
  void line_step(bool carry) { along_edge_.step(carry ? de1_ : de0_); }
  void span_load() {
    along_line_.load(along_edge_.value());
    span_dx_ = dx_;
  }
  void span_step() { along_line_.step(span_dx_); }

  Value edge_value() const { return along_edge_.value(); }
  Value value() const { return along_line_.value(); }
  Value dx() const { return span_dx_; }

 private:
  LineInterpolator<W> along_edge_, along_line_;
  Value dx_, de0_, de1_, span_dx_;
};

}  // namespace halfway::golden

// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/raster/slope_walker.vhd.
#pragma once

#include "golden/edge_walker.hpp"
#include "golden/line_interpolator.hpp"

namespace halfway::golden {

class SlopeWalker {
 public:
  using EdgeX = Word<Published::c_edge_x_bits>;

  void load(EdgeX x, EdgeX slope) {
    x_.load(x);
    slope_ = slope;
  }
  void step() { x_.step(slope_); }
  SpanXWord x() const {
    return SpanXWord::from_bits(
        static_cast<std::uint64_t>(x_.value().value() >> Published::c_edge_x_fraction_bits));
  }

 private:
  LineInterpolator<Published::c_edge_x_bits> x_;
  EdgeX slope_;
};

}  // namespace halfway::golden

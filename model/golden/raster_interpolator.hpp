// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/objects/raster_interpolator.vhd.
#pragma once

#include "golden/words.hpp"

namespace halfway::golden {

/// A value at each pixel of a strip, in raster order.
template <int W>
class RasterInterpolator {
 public:
  using Value = Word<W>;
  /// Eighths of a change need three bits more than the value, even if that wraps.
  using Change = Word<W + 3>;

  void load(Value start, Change dx, Change dy) {
    next_line_ = start;
    dx_ = dx;
    dy_ = dy;
  }
  void line_step() {
    value_ = next_line_;
    next_line_ += Value::from_bits(dy_.bits());
  }
  void pixel_step() { value_ += Value::from_bits(dx_.bits()); }

  /// At the centre of the pixel.
  Value value() const { return value_; }
  /// At a subpixel of `side` by `side`.
  Value value(int side, int row, int column) const {
    const std::uint64_t eighths =
        8 * value_.bits() + from_centre(side, column, dx_) + from_centre(side, row, dy_);
    return Value::from_bits(eighths >> 3);
  }

 private:
  static_assert(W <= 58);
  // In eighths of a pixel. Sums wrap.
  static std::uint64_t from_centre(int side, int index, Change change) {
    return static_cast<std::uint64_t>((2 * index + 1 - side) * (4 / side)) *
           static_cast<std::uint64_t>(change.value());
  }
  Value next_line_, value_;
  Change dx_, dy_;
};

}  // namespace halfway::golden

// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/interpolation/line_interpolator.vhd.
#pragma once

#include "golden/words.hpp"

namespace halfway::golden {

template <int W>
class LineInterpolator {
 public:
  void load(Word<W> start) { value_ = start; }
  void step(Word<W> increment) { value_ += increment; }
  Word<W> value() const { return value_; }

 private:
  Word<W> value_;
};

}  // namespace halfway::golden

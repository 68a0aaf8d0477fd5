// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/interpolation/part_interpolator.vhd.
#pragma once

#include "golden/words.hpp"

namespace halfway::golden {

/// In one clock call either load or step.
template <int W>
class PartInterpolator {
 public:
  void load(Word<W> start) {
    value_ = start;
    carry_ = false;
  }
  void step(Word<W> increment, bool carry) {
    const Word<W> before = value_;
    value_ += increment;
    if (carry) value_ += Word<W>::from_bits(1);
    // The sum wrapped: it is smaller, or it is equal because of a carry and an increment of all ones.
    carry_ = value_.bits() < before.bits() || (carry && value_.bits() == before.bits());
  }
  Word<W> value() const { return value_; }
  bool carry() const { return carry_; }

 private:
  Word<W> value_;
  bool carry_ = false;
};

}  // namespace halfway::golden

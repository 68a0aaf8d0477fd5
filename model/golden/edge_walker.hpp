// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/raster/edge_walker.vhd.
#pragma once

#include "golden/words.hpp"

namespace halfway::golden {

using SpanXWord = Word<Exact::c_span_x_bits>;

/// Input of a load: one section of an edge of an init vector.
struct EdgeStart {
  SpanXWord x, quotient;
  std::uint32_t remainder = 0, divisor = 0, error = 0;  ///< error: in format edge_error
  bool carry = false;
};

class EdgeWalker {
 public:
  void load(const EdgeStart& start) {
    x_ = start.x;
    quotient_ = start.quotient;
    remainder_ = start.remainder;
    rise_ = static_cast<std::uint32_t>(
        low_bits(std::uint64_t{start.divisor} - start.remainder, Exact::c_edge_error_bits));
    reduced_ = Reduced::from_bits(start.error);
    carry_ = start.carry;
  }
  void step() {
    x_ += quotient_;
    if (carry_) x_ += SpanXWord::from_bits(1);
    const bool below = reduced_.value() < 0;
    reduced_ += Reduced::from_bits(below ? std::uint64_t{rise_} : ~std::uint64_t{remainder_} + 1);
    carry_ = reduced_.value() < 0;
  }
  SpanXWord x() const { return x_; }
  bool carry() const { return carry_; }

 private:
  using Reduced = Word<Exact::c_edge_error_bits + 1>;
  SpanXWord x_, quotient_;
  std::uint32_t remainder_ = 0, rise_ = 0;
  Reduced reduced_;  ///< before the first step the error, then the error minus the remainder
  bool carry_ = false;
};

}  // namespace halfway::golden

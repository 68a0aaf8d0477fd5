// SPDX-License-Identifier: Apache-2.0
// Twin of rtl/raster/edge_walker.vhd.
#pragma once

#include "golden/word.hpp"

namespace halfway::golden {

using SpanXWord = Word<Exact::c_span_x_bits>;

/// What an edge_walker loads: a section of an init vector's edge.
struct EdgeStart {
  SpanXWord x, quotient;
  std::uint32_t remainder = 0, divisor = 0, error = 0;  ///< edge_error
  bool carry = false;
};

class EdgeWalker {
 public:
  void load(const EdgeStart& start) { r_ = start; }
  void step() {
    r_.x += r_.quotient;
    if (r_.carry) r_.x += SpanXWord::from_bits(1);
    r_.carry = r_.error < r_.remainder;
    r_.error = wrapped(r_.error - r_.remainder + (r_.carry ? r_.divisor : 0));
  }
  SpanXWord x() const { return r_.x; }
  bool carry() const { return r_.carry; }
  const EdgeStart& registers() const { return r_; }

 private:
  static std::uint32_t wrapped(std::uint32_t value) {
    return static_cast<std::uint32_t>(low_bits(value, Exact::c_edge_error_bits));
  }
  EdgeStart r_;
};

}  // namespace halfway::golden

// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/arithmetic/dot_product.vhd.
#pragma once

#include "golden/vector_shift.hpp"

namespace halfway::golden {

/// Exact. With components of B bits the result has 2 B + 1 bits.
constexpr std::int64_t dot_product(const Axes& a, const Axes& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace halfway::golden

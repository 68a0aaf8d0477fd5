// SPDX-License-Identifier: Apache-2.0
// Divides many numerators by one divisor. Each quotient is rounded correctly; only one floating-point
// division is needed.
#pragma once

#include <cstdint>

#include "common/to_integer.hpp"

namespace halfway {

using Int128 = __int128;

/// Divides by a positive number below 2^96. The reciprocal is the only division. A quotient is estimated with
/// it and corrected by the exact remainder, so slivers with very large quotients are as exact as other
/// triangles.
class ExactDivider {
 public:
  explicit ExactDivider(Int128 divisor)
      : divisor_(divisor), reciprocal_(1.0 / static_cast<double>(divisor)) {}

  /// round(numerator / divisor), halves up; |numerator| < 2^125.
  Int128 rounded(Int128 numerator) const {
    // round(n/d) = floor((2n + d) / 2d) = floor(n/d + 1/2)
    Int128 quotient = 0;
    Int128 remainder = numerator + divisor_ / 2;  // truncation of an odd divisor's half has no effect
    // Each iteration reduces the remainder by a factor of about 2^50.
    while (remainder < 0 || remainder >= divisor_) {
      Int128 part = to_integer<Int128>(static_cast<double>(remainder) * reciprocal_);
      if (part == 0) part = remainder < 0 ? -1 : 1;
      quotient += part;
      remainder -= part * divisor_;
    }
    return quotient;
  }

 private:
  Int128 divisor_;
  double reciprocal_;
};

}  // namespace halfway

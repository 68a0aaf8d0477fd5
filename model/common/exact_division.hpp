// SPDX-License-Identifier: Apache-2.0
// Divides many numerators by one divisor. Each quotient is rounded correctly; only one floating-point
// division is needed.
#pragma once

#include <cmath>
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
      : divisor_(divisor),
        reciprocal_(1.0 / to_double(divisor)),
        most_estimate_(divisor < Int128{1} << 61 ? 0x1p50 : 0.0) {}

  /// round(numerator / divisor), halves up; |numerator| < 2^125.
  Int128 rounded(Int128 numerator) const {
    // round(n/d) = floor((2n + d) / 2d) = floor(n/d + 1/2). Truncation of an odd divisor's half has no
    // effect.
    const Int128 raised = numerator + (divisor_ >> 1);
    const double estimate = to_double(raised) * reciprocal_;
    // Six roundings: the estimate is within 7/8 of the quotient. Truncated, and one less if it is negative,
    // it is off by at most one.
    if (!(std::abs(estimate) < most_estimate_)) return floored(raised);
    const auto quotient = to_integer<std::int64_t>(estimate) - (estimate < 0.0);
    // The remainder is less than two divisors from 0: its low 64 bits suffice.
    const auto divisor = static_cast<std::int64_t>(divisor_);
    const auto remainder =
        static_cast<std::int64_t>(static_cast<std::uint64_t>(raised) -
                                  static_cast<std::uint64_t>(quotient) * static_cast<std::uint64_t>(divisor));
    return quotient + (remainder >= divisor) - (remainder < 0);
  }

 private:
  [[gnu::noinline]] Int128 floored(Int128 numerator) const {
    Int128 quotient = 0, remainder = numerator;
    // Each iteration reduces the remainder by a factor of about 2^50.
    while (remainder < 0 || remainder >= divisor_) {
      Int128 part = to_integer<Int128>(to_double(remainder) * reciprocal_);
      if (part == 0) part = remainder < 0 ? -1 : 1;
      quotient += part;
      remainder -= part * divisor_;
    }
    return quotient;
  }
  // Two conversions of 64 bits are quicker than the library's one of 128 bits. Within three roundings.
  static double to_double(Int128 value) {
    const auto low = static_cast<std::int64_t>(value);
    const auto high = static_cast<std::int64_t>((value - low) >> 64);
    return 0x1p64 * static_cast<double>(high) + static_cast<double>(low);
  }

  Int128 divisor_;
  double reciprocal_;
  double most_estimate_;  ///< below it one step of 64 bits corrects an estimate
};

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// The one place where a real number becomes an integer: a cast of what does not fit is undefined.
#pragma once

#include <concepts>
#include <limits>

namespace halfway {

/// Towards zero, held within Integer; 0 for what is no number. tb/stability/conversions.cpp lists the callers.
template <class Integer, std::floating_point Real>
constexpr Integer to_integer(Real value) {
  using Range = std::numeric_limits<Integer>;
  // 2^digits: the largest integer itself may not be a Real.
  constexpr Real c_half = static_cast<Real>(Integer{1} << (Range::digits - 1)), c_end = 2 * c_half;
  if (value >= c_end) return Range::max();
  if (value <= (Range::is_signed ? -c_end : Real{-1})) return Range::min();
  return value == value ? static_cast<Integer>(value) : Integer{0};
}

}  // namespace halfway

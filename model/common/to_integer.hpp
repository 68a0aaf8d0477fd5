// SPDX-License-Identifier: Apache-2.0
// All conversions from a real number to an integer use this function. A plain cast is undefined if the value
// does not fit.
#pragma once

#include <concepts>
#include <limits>

namespace halfway {

/// Rounds towards zero and clamps to the range of Integer. NaN gives 0. `make sanitize` finds
/// conversions by a plain cast that do not fit.
template <class Integer, std::floating_point Real>
constexpr Integer to_integer(Real value) {
  using Range = std::numeric_limits<Integer>;
  // 2^digits. Real cannot represent every Integer, so the largest Integer is not used as the limit.
  constexpr Real c_half = static_cast<Real>(Integer{1} << (Range::digits - 1)), c_end = 2 * c_half;
  if (value >= c_end) return Range::max();
  if (value <= (Range::is_signed ? -c_end : Real{-1})) return Range::min();
  return value == value ? static_cast<Integer>(value) : Integer{0};
}

}  // namespace halfway

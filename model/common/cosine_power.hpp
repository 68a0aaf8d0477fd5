// SPDX-License-Identifier: Apache-2.0
// The slope of a power of the cosine.
#pragma once

#include <cmath>
#include <limits>

namespace halfway {

/// The greatest slope of cos^n of an angle, where tan^2 of the angle is 1/(n - 1): sqrt(n) (1 - 1/n)^((n -
/// 1)/2) for n >= 1. Infinite below.
inline double steepest_slope(double n) {
  if (!(n >= 1.0)) return std::numeric_limits<double>::infinity();
  return std::sqrt(n) * std::pow(1.0 - 1.0 / n, (n - 1.0) / 2);
}

}  // namespace halfway

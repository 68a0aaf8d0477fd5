// SPDX-License-Identifier: Apache-2.0
// The bell: an approximation of a highlight's cos^n. A few tables of cosines then serve every exponent n >=
// 1. Exponents are clamped to 1 ... 10^15.
#pragma once

#include <map>
#include <span>

namespace halfway {

/// gain * cos^power(scale * x) for |scale * x| < pi/2, zero outside. The table contains the power, the angle
/// words contain the scale, and the factor contains the gain.
struct Bell {
  int power;
  double scale;       ///< > 0
  double gain = 1.0;  ///< >= 0
};

/// The sum of all powers.
inline constexpr unsigned c_all_powers = 31;

/// Preset exact: the bell for max(0, cos x)^n, x in [0, pi], n = exponent. Its power is 1, 2, 4, 8 or 16. For
/// these exponents it is exact: scale = gain = 1. The exact function is zero beyond pi/2 (N.H < 0). A bell
/// with scale < 1 is not yet zero there: that is part of the error.
///
/// For each power, scale and gain have the least maximum error. The power minimizes the sum of this error and
/// the error added by a table of 2^9 entries, which is larger for steeper bells. For n >= 2 that sum is
/// within 1e-5 of the least sum of all such bells. Between 1 and 2 no such bell is good: cos^n has a corner
/// at pi/2 there, and the error is up to 8.7/255.
/// `powers` is the sum of the powers that may be used.
Bell fitted_bell(double exponent, unsigned powers = c_all_powers);
/// By exponent. Each exponent is fitted once.
using Bells = std::map<double, Bell>;
Bells fitted_bells(std::span<const double> exponents, unsigned powers = c_all_powers);

/// Preset published: a(n) of cos^n x ~ cos^2 ax, from 1/(n+1) = (2a^2 (1 - cos(pi/2a)) - 1)/(4a^2 - 1). Both
/// sides have the same integral weighted by sin x, the first over [0, pi/2], the second over [0, pi/2a]. n <
/// 2 gives a < 1: the bell then extends beyond pi/2, and the equation includes that part.
double published_scale(double exponent);

/// An upper bound of the largest |max(0, cos x)^n - bell(x)| over x in [0, pi], at most 2e-6 above it. Every
/// interval of x is bounded; the bound does not depend on sampling.
double fit_error(double exponent, const Bell& bell);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// The bell that stands for a highlight's cos^n, so that few tables of cosines serve every exponent n >= 1.
// Here a smaller one is taken as 1, one above 10^15 as 10^15.
#pragma once

#include <map>
#include <span>

namespace halfway {

/// gain * cos^power(scale * x) where |scale * x| < pi/2, zero outside. The table knows the power, the angle
/// words carry the scale, the factor the gain.
struct Bell {
  int power;
  double scale;       ///< > 0
  double gain = 1.0;  ///< >= 0
};

/// Preset exact: the bell for max(0, cos x)^n, x in [0, pi], n = exponent. Its power is 1, 2, 4, 8 or 16; at
/// these exponents it is exact, scale = gain = 1. The truth is zero past pi/2 (N.H < 0), where a bell of
/// scale < 1 is not yet: that counts as error.
///
/// For each power, scale and gain have the least largest error; the power is the one where this and what a
/// table of 2^9 entries adds (steeper bells suffer more) are least together. That sum is within 1e-5 of the
/// least that any such bell has, for n >= 2. Between 1 and 2 no such bell is good: cos^n has a corner at pi/2
/// there, and the error reaches 8.7/255.
Bell fitted_bell(double exponent);
/// By exponent, each fitted once.
using Bells = std::map<double, Bell>;
Bells fitted_bells(std::span<const double> exponents);

/// Preset published: a(n) of cos^n x ~ cos^2 ax, from 1/(n+1) = (2a^2 (1 - cos(pi/2a)) - 1)/(4a^2 - 1): both
/// have the same integral with sin x, one over [0, pi/2], the other over [0, pi/2a]. n < 2 makes a < 1: then
/// the bell runs past pi/2, and the equation counts what lies there.
double published_scale(double exponent);

/// A bound on the largest |max(0, cos x)^n - bell(x)| over x in [0, pi], at most 2e-6 above it. Every cell of
/// x is bounded, none sampled.
double fit_error(double exponent, const Bell& bell);

}  // namespace halfway

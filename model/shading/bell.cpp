// SPDX-License-Identifier: Apache-2.0
#include "shading/bell.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "common/cosine_power.hpp"

namespace halfway {
namespace {

constexpr double c_half_pi = std::numbers::pi / 2;
constexpr std::array c_powers = {1, 2, 4, 8, 16};

double clamped(double exponent) {
  return std::max(1.0, std::min(exponent, 1e15));  // in this order NaN gives 1
}

// max(0, cos x)^n for x in [0, pi]. Close to the peak, cos x rounds to 1, and a large n amplifies that error.
// Therefore compute 1 - cos x instead.
double lobe(double exponent, double x) {
  const double half_sine = std::sin(x / 2), versine = 2 * half_sine * half_sine;
  return versine < 1.0 ? std::exp(exponent * std::log1p(-versine)) : 0.0;
}

// cos^power(u), zero beyond pi/2. The power is a power of two.
double table_cosine(int power, double u) {
  if (u >= c_half_pi) return 0.0;
  double value = std::cos(u);
  for (; power > 1; power /= 2) value *= value;
  return value;
}

// The greatest slope of cos^power(v pi/2) with respect to v.
double steepness(int power) {
  return c_half_pi * steepest_slope(power);
}

// Greatest distance between the angle and the sample's angle, in half bells: half a cell of a table of 2^9
// entries, plus the drift of the angle word.
constexpr double c_angle_error = 0x1p-10 + 0x1p-11;

// cos^n sampled at equal steps from 0 to where it is below 4e-6. For n >= 2 the second derivatives of cos^n
// and of a bell fitted to it are at most 1.1 n: between samples the error is at most 7e-6 larger, and beyond
// the last sample at most 4e-6 larger.
struct SampledLobe {
  double step;
  std::vector<double> value;  // starts at x = step
};

SampledLobe sampled_lobe(double exponent) {
  constexpr int c_samples = 1024;
  SampledLobe lobe_samples;
  lobe_samples.step = std::min(c_half_pi, 5.0 / std::sqrt(exponent)) / c_samples;
  for (int i = 1; i <= c_samples; ++i) lobe_samples.value.push_back(lobe(exponent, i * lobe_samples.step));
  return lobe_samples;
}

struct Fit {
  Bell bell;
  double error;
};

// Scale s and gain k with the least maximum error E for one power m.
//
// The error is f - k g with f = cos^n x and g = cos^m sx. It has its extremes, with alternating signs, at x =
// 0 and at two more places. Let n > m (for n < m the signs are reversed). Then s > 1. f/(k g) falls before it
// rises, because its logarithm has the slope tan x (m s tan(sx)/tan x - n) and the bracket increases. So f -
// k g is positive, negative, positive. Up to the first zero both f and f/(k g) fall, and so does the error,
// from its value 1 - k at x = 0. That value 1 - k is E. For one s the error is within E where (f - g)/(1 - g)
// and (g - f)/(1 + g) are at most E. For each x the first increases with s and the second decreases, and so
// do their maxima. The best s is where these maxima are equal. No other bell is better: it would have to
// cross this one twice, but cos(sx)/cos(s'x) is monotonic.
//
// Beyond pi/2, where f is zero, g is smaller than at pi/2.
Fit fit(double exponent, const SampledLobe& truth, int power) {
  if (exponent == power) return {{power, 1.0, 1.0}, 0.0};
  const double sign = exponent > power ? 1.0 : -1.0, natural = std::sqrt(exponent / power);
  double low = 0.5 * natural, high = 2.0 * natural, scale = natural, error = 0.0;
  for (int i = 0; i < 40; ++i) {
    scale = std::midpoint(low, high);
    double below = 0.0, above = 0.0;  // greatest excess of cos^n over the bell, and of the bell over cos^n
    for (std::size_t j = 0; j < truth.value.size(); ++j) {
      const double f = truth.value[j],
                   g = table_cosine(power, scale * truth.step * static_cast<double>(j + 1));
      below = std::max(below, (f - g) / (1.0 - sign * g));
      above = std::max(above, (g - f) / (1.0 + sign * g));
    }
    error = std::max(below, above);
    (below < above ? low : high) = scale;
  }
  return {{power, scale, 1.0 - sign * error}, error};
}

}  // namespace

Bell fitted_bell(double exponent, unsigned powers) {
  exponent = clamped(exponent);
  const SampledLobe truth = sampled_lobe(exponent);
  Bell best{};
  double least = std::numeric_limits<double>::infinity();
  for (const int power : c_powers) {
    if ((powers & static_cast<unsigned>(power)) == 0) continue;
    const auto [bell, error] = fit(exponent, truth, power);
    const double total = error + c_angle_error * steepness(power);
    if (total < least) least = total, best = bell;
  }
  return best;
}

Bells fitted_bells(std::span<const double> exponents, unsigned powers) {
  Bells bells;
  for (const double exponent : exponents)
    if (!bells.contains(exponent)) bells.emplace(exponent, fitted_bell(exponent, powers));
  return bells;
}

double published_scale(double exponent) {
  // With t = pi/4a and q = pi/2 the right side of the equation is (q^2 sin^2 t - t^2)/(q^2 - t^2). This form
  // has no cancellation for large a. It is 0/0 at a = 1/2, t = q, that is at n = 0. It increases with t: as
  // 0.60 t^2 for small t and as 0.41 t^2 at q.
  const double target = 1.0 / (clamped(exponent) + 1.0);
  double low = std::sqrt(target), high = c_half_pi * low;
  double t = std::midpoint(low, high);
  while (low < t && t < high) {
    const double sine = c_half_pi * std::sin(t);
    const double integral = (sine * sine - t * t) / (c_half_pi * c_half_pi - t * t);
    (integral < target ? low : high) = t;
    t = std::midpoint(low, high);
  }
  return c_half_pi / (2 * t);
}

double fit_error(double exponent, const Bell& bell) {
  exponent = clamped(exponent);
  struct Point {
    double x, truth, bell;
    double error() const { return std::abs(truth - bell); }
  };
  const auto at = [&](double x) {
    return Point{x, lobe(exponent, x), bell.gain * table_cosine(bell.power, bell.scale * x)};
  };

  // Bounds of |f''|. For the lobe the bound is n if n >= 2; for smaller n the curvature is unbounded towards
  // pi/2. Beyond pi/2, or beyond the end of the bell, one of the two is zero and the other is smaller than
  // there.
  const auto lobe_curvature = [&](double to) {
    if (exponent >= 2.0) return exponent;
    return exponent * std::max(1.0, (exponent - 1.0) * std::pow(std::max(0.0, std::cos(to)), exponent - 2.0));
  };
  const double bell_curvature = bell.gain * bell.power * bell.scale * bell.scale;
  const double end = std::min(c_half_pi, c_half_pi / bell.scale);

  constexpr double c_slack = 1e-6;      // excess of the bound over the largest error found
  constexpr double c_rounding = 1e-12;  // generous bound for the rounding of doubles here
  constexpr int c_first_cells = 64;
  std::vector<Point> ends;  // of the open cells, the nearest last
  double seen = 0.0, bound = 0.0;
  for (int i = c_first_cells; i >= 0; --i) {
    ends.push_back(at(end * i / c_first_cells));
    seen = std::max(seen, ends.back().error());
  }
  Point from = ends.back();
  ends.pop_back();
  while (!ends.empty()) {
    const Point to = ends.back();
    const double width = to.x - from.x;
    // Both functions decrease, and both are close to their chords.
    const double by_fall = std::max(from.truth - to.bell, from.bell - to.truth);
    const double by_chord =
        std::max(from.error(), to.error()) + (lobe_curvature(to.x) + bell_curvature) * width * width / 8;
    const double cell_bound = std::min(by_fall, by_chord);
    const double middle = std::midpoint(from.x, to.x);
    if (cell_bound <= seen + c_slack || middle <= from.x || middle >= to.x) {
      bound = std::max(bound, cell_bound);
      from = to;
      ends.pop_back();
    } else {
      ends.push_back(at(middle));
      seen = std::max(seen, ends.back().error());
    }
  }
  return bound + c_rounding;
}

}  // namespace halfway

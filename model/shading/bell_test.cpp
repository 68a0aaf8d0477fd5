// SPDX-License-Identifier: Apache-2.0
// Compares the published scale with the paper's table and equation, the fitted bell with all other bells, the
// error bound with samples and MPFR, and the complete path from an angle word to a colour with cos^n.
#include "shading/bell.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <ostream>
#include <utility>
#include <vector>

#include "common/test/big_real.hpp"
#include "scene/test/random_scenes.hpp"
#include "words/generator/cosine.hpp"

namespace halfway {
namespace {

constexpr double c_pi = std::numbers::pi;
constexpr std::array c_powers = {1, 2, 4, 8, 16};

// ---- preset published

TEST(PublishedScale, Table1) {
  struct Row {
    double n, a;
  };
  for (const auto& [n, a] : {Row{2, 1.0000}, Row{5, 1.4502}, Row{10, 1.9845}, Row{20, 2.7582},
                             Row{50, 4.3143}, Row{100, 6.0791}, Row{500, 13.5535}})
    EXPECT_EQ(std::round(published_scale(n) * 1e4), std::round(a * 1e4))
        << "n = " << n << ": a = " << published_scale(n);
}

/// The right side of the equation as printed, times n + 1.
double equation(double n, double a) {
  const BigReal four_a2 = BigReal(4.0) * BigReal(a) * BigReal(a);
  const BigReal versine = BigReal(1.0) - cos(BigReal::pi() / (BigReal(2.0) * BigReal(a)));
  const BigReal right = (four_a2 / BigReal(2.0) * versine - BigReal(1.0)) / (four_a2 - BigReal(1.0));
  return static_cast<double>((BigReal(n) + BigReal(1.0)) * right - BigReal(1.0));
}

TEST(PublishedScale, SolvesTheEquation) {
  std::vector<double> exponents = {1.0,  std::nextafter(1.0, 2.0),
                                   1.5,  std::nextafter(2.0, 1.0),
                                   2.0,  std::nextafter(2.0, 3.0),
                                   1e6,  1e9,
                                   1e12, 1e15};
  RandomScenes random(1);
  for (int i = 0; i < 200; ++i) {
    exponents.push_back(random.within(1.0, 1e6));
    exponents.push_back(random.log_within(1.0, 1e6));
    exponents.push_back(random.log_within(1e6, 1e15));
  }
  double worst = 0.0;
  for (const double n : exponents) {
    const double a = published_scale(n), residual = std::abs(equation(n, a));
    worst = std::max(worst, residual);
    // An error of half a last bit in a causes up to one epsilon of residual.
    EXPECT_LE(residual, 6 * std::numeric_limits<double>::epsilon()) << "n = " << n << ", a = " << a;
  }
  EXPECT_GT(worst, 0.0);
}

// ---- preset exact

double lobe(double n, double x) {
  if (x >= c_pi / 2) return 0.0;
  const long double sine = std::sin(static_cast<long double>(x) / 2);
  return static_cast<double>(std::exp(n * std::log1p(-2 * sine * sine)));
}

double value(const Bell& bell, double x) {
  const double u = bell.scale * x;
  return u < c_pi / 2 ? bell.gain * std::pow(std::cos(u), bell.power) : 0.0;
}

/// Places that cover the lobe, the bell, and all of [0, pi]; ascending.
std::vector<double> places(double n, double scale, int count) {
  std::vector<double> x = {c_pi / 2, std::min(c_pi, c_pi / (2 * scale))};
  for (const double to : {c_pi, 8 / std::sqrt(n), c_pi / (2 * scale)})
    for (int i = 0; i <= count; ++i) x.push_back(std::min(c_pi, to * i / count));
  std::ranges::sort(x);
  return x;
}

struct Extreme {
  double x = 0.0, error = 0.0;
};
Extreme greatest_sampled(double n, const Bell& bell, int count) {
  Extreme greatest;
  for (const double x : places(n, bell.scale, count)) {
    const double error = std::abs(lobe(n, x) - value(bell, x));
    if (error > greatest.error) greatest = {x, error};
  }
  return greatest;
}

TEST(FittedBell, IsExactAtTheTablesPowers) {
  for (const int n : c_powers) {
    const Bell bell = fitted_bell(n);
    EXPECT_EQ(bell.power, n);
    EXPECT_EQ(bell.scale, 1.0) << "n = " << n;
    EXPECT_EQ(bell.gain, 1.0) << "n = " << n;
    for (const double by : {1 - 1e-9, 1 + 1e-9}) {
      if (n * by < 1.0) continue;
      const Bell nearby = fitted_bell(n * by);
      EXPECT_EQ(nearby.power, n);
      EXPECT_NEAR(nearby.scale, 1.0, 1e-8) << "n = " << n;
      EXPECT_NEAR(nearby.gain, 1.0, 1e-8) << "n = " << n;
    }
  }
}

/// Steepness in half bells and in colour steps: the greatest slope of cos^power(v pi/2).
double steepest(int power) {
  double slope = 0.0;
  for (int i = 0; i <= 4000; ++i) {
    const double u = c_pi / 2 * i / 4000;
    slope = std::max(slope, c_pi / 2 * power * std::pow(std::cos(u), power - 1) * std::sin(u));
  }
  return slope;
}

/// The second term by which the power is chosen, as the header defines it: half a cell of 2^9 and the drift
/// of the angle, in units of 1.
double weighed(int power) {
  return (0x1p-10 + 0x1p-11) * steepest(power);
}

std::vector<double> exponents_between(double low, double high, int count) {
  std::vector<double> exponents;
  for (int i = 0; i <= count; ++i) exponents.push_back(low * std::pow(high / low, double(i) / count));
  return exponents;
}

// Three extremes of alternating signs. A bell of the same power with a smaller error everywhere would have to
// cross this one twice, but two such bells cross at most once (apart from x = 0).
TEST(FittedBell, ErrorAlternates) {
  std::vector<double> exponents = exponents_between(2.0, 1e6, 150);
  for (double n = 2.01; n < 32.0; n += 0.07) exponents.push_back(n);
  for (const double n : exponents) {
    const Bell bell = fitted_bell(n);
    if (bell.power == n) continue;
    const double sign = n > bell.power ? 1.0 : -1.0;
    const double least = fit_error(n, bell) - 1e-5;
    int extremes = 0;
    for (const double x : places(n, bell.scale, 4000)) {
      const double wanted = extremes % 2 == 0 ? sign : -sign;
      if (wanted * (lobe(n, x) - value(bell, x)) >= least) ++extremes;
      if (extremes == 3) break;
    }
    EXPECT_EQ(extremes, 3) << "n = " << n << ": power " << bell.power << ", scale " << bell.scale << ", gain "
                           << bell.gain << ", least " << least;
  }
}

// In the limit both are Gaussians.
TEST(FittedBell, FollowsTheRootOfALargeExponent) {
  const Bell million = fitted_bell(1e6);
  for (const double n : {1e7, 1e9, 1e12, 1e15}) {
    const Bell bell = fitted_bell(n);
    EXPECT_EQ(bell.power, 16);
    EXPECT_NEAR(bell.scale / std::sqrt(n), million.scale / 1e3, 1e-6) << "n = " << n;
    EXPECT_NEAR(bell.gain, million.gain, 1e-6) << "n = " << n;
    EXPECT_NEAR(fit_error(n, bell), fit_error(1e6, million), 3e-6) << "n = " << n;
  }
}

TEST(Bell, ExponentsOutOfRangeAreClamped) {
  constexpr double c_infinity = std::numeric_limits<double>::infinity();
  const auto expect_same = [](double n, double clamped) {
    const Bell a = fitted_bell(n), b = fitted_bell(clamped);
    ASSERT_EQ(a.power, b.power) << n;
    ASSERT_EQ(a.scale, b.scale) << n;
    ASSERT_EQ(a.gain, b.gain) << n;
    ASSERT_EQ(published_scale(n), published_scale(clamped)) << n;
    EXPECT_EQ(fit_error(n, b), fit_error(clamped, b)) << n;
  };
  for (const double n : {0.999, 0.5, 0.0, -1.0, -7.0, -c_infinity, std::nan("")}) expect_same(n, 1.0);
  for (const double n : {2e15, 1e300, c_infinity}) expect_same(n, 1e15);
}

// ---- the bound

std::vector<Bell> bells_to_bound(double n, RandomScenes& random) {
  const Bell fitted = fitted_bell(n);
  std::vector<Bell> bells = {fitted, {2, published_scale(n)}};
  bells.push_back({fitted.power, fitted.scale * random.within(0.5, 2.0), random.within(0.5, 1.5)});
  bells.push_back({c_powers[static_cast<std::size_t>(random.within(0.0, 4.999))],
                   random.log_within(0.3, 2 * std::sqrt(n)), random.within(0.2, 2.0)});
  return bells;
}

BigReal exact_error(double n, const Bell& bell, double x) {
  const BigReal zero, half_pi = BigReal::pi() / BigReal(2.0), u = BigReal(bell.scale) * BigReal(x);
  const BigReal truth = BigReal(x) < half_pi ? pow(cos(BigReal(x)), BigReal(n)) : zero;
  const BigReal approximation = u < half_pi ? BigReal(bell.gain) * pow(cos(u), BigReal(bell.power)) : zero;
  return abs(truth - approximation);
}

TEST(FitError, BoundsExactErrors) {
  RandomScenes random(3);
  std::vector<double> exponents = {1.0, 1.5, 2.0, 2.5, 1000.0, 1e6, 1e9, 1e15};
  for (int i = 0; i < 20; ++i) exponents.push_back(random.log_within(1.0, 1e6));
  for (const double n : exponents)
    for (const Bell& bell : bells_to_bound(n, random)) {
      const double bound = fit_error(n, bell);
      const auto expect_bounded = [&](double x) {
        const BigReal error = exact_error(n, bell, x);
        EXPECT_FALSE(BigReal(bound) < error)
            << "n = " << n << ": power " << bell.power << ", scale " << bell.scale << ", gain " << bell.gain
            << ", at " << x << ", not " << bound;
        return static_cast<double>(error);
      };
      EXPECT_GE(expect_bounded(greatest_sampled(n, bell, 20000).x), bound - 1e-5) << "n = " << n;
      for (int i = 0; i < 60; ++i) expect_bounded(random.within(0.0, i % 2 == 0 ? c_pi : 5 / std::sqrt(n)));
    }
}

// cos^2 alone has an error of 10 of 255 at n = 5 and of 18 at n = 500.
TEST(FitError, OfThePublishedBell) {
  EXPECT_NEAR(fit_error(5, {2, published_scale(5)}), 0.0398, 5e-5);
  EXPECT_NEAR(fit_error(500, {2, published_scale(500)}), 0.0719, 1e-4);
}

// ---- from an angle word to a colour

constexpr double c_steps = 255.0;    // a highlight of full range
constexpr double c_drift = 0x1p-11;  // of an angle word, in half bells: format `angle`
const tables::CosineSize c_size = tables::CosineSizes{}.exact.front();

/// The parts of a highlight's difference from steps * cos^n, in colour steps.
struct Parts {
  double fit, table, drift;
  double factor = 0x1p-9, rounding = 0.5;
  double total() const { return fit + table + drift + factor + rounding; }
};

std::ostream& operator<<(std::ostream& out, const Parts& p) {
  return out << p.total() << " steps (fit " << p.fit << ", table " << p.table << ", drift " << p.drift
             << ", factor " << p.factor << ", rounding " << p.rounding << ")";
}

/// For a bell of gain 1: the parts that depend on the power.
struct PowerParts {
  double table, drift;
};
const PowerParts& power_parts(int power) {
  static std::map<int, PowerParts> known;
  auto [it, is_new] = known.try_emplace(power);
  if (is_new) {
    const tables::CosineTable table = tables::cosine_table(true, power, c_size);
    it->second = {c_steps * tables::table_error(table), c_steps * c_drift * steepest(power)};
  }
  return it->second;
}

Parts parts(double n, const Bell& bell) {
  const auto& [table, drift] = power_parts(bell.power);
  return {c_steps * fit_error(n, bell), bell.gain * table, bell.gain * drift};
}

TEST(Bell, BelowTwoNoBellIsGood) {
  double most = 0.0, at = 0.0;
  for (int i = 0; i <= 400; ++i) {
    const double n = 1.0 + i / 400.0, steps = c_steps * fit_error(n, fitted_bell(n));
    if (steps > most) most = steps, at = n;
  }
  EXPECT_NEAR(most, 8.67, 0.01) << "n = " << at;
  EXPECT_NEAR(at, 1.305, 0.01);
}

// For every n in [2, 1000], not only for the tested ones.
//
// From n1 to n > n1 the error of one bell increases by at most (n - n1)/(e n1), because |d/dn cos^n x| <=
// 1/(e n). fitted_bell minimizes the sum of error and `weighed`. At n this sum is at most its value at n1
// with n1's bell, plus this increase, plus c_not_least. The other parts of the total depend on the chosen
// power. The worst power is assumed for them, and a gain of 1 + 5/255, because |gain - 1| is at most the
// error.
TEST(Bell, ExactBellIsWithinFiveSteps) {
  constexpr double c_most = 5.0, c_not_least = 1e-5;
  double other_errors = 0.0;
  for (const int power : c_powers) {
    const auto& [table, drift] = power_parts(power);
    other_errors =
        std::max(other_errors, (1 + c_most / c_steps) * (table + drift) - c_steps * weighed(power));
  }
  other_errors += Parts{}.factor + Parts{}.rounding + c_steps * c_not_least;

  double worst_exponent = 0.0;
  Parts worst{};
  // The least sum at n. Also records the total there.
  const auto least_sum = [&](double n) {
    const Bell bell = fitted_bell(n);
    const Parts p = parts(n, bell);
    EXPECT_LE(p.total(), c_most) << "n = " << n << ": " << p;
    EXPECT_LE(std::abs(bell.gain - 1), c_most / c_steps) << "n = " << n;
    if (p.total() > worst.total()) worst = p, worst_exponent = n;
    return p.fit + c_steps * weighed(bell.power);
  };
  double most_bound = 0.0;
  for (int n = 2; n < 1000; ++n) {
    double from = n, sum = least_sum(n);
    while (from < n + 1) {
      // Advance as far as the bound allows.
      const double room = c_most - other_errors - sum, reach = from * room * std::numbers::e / c_steps;
      ASSERT_GT(reach, 1e-6) << "between n = " << from << " and " << n + 1 << " the bound exceeds " << c_most;
      const double to = std::min<double>(n + 1, from + reach);
      most_bound =
          std::max(most_bound, sum + other_errors + c_steps * (to - from) / (std::numbers::e * from));
      from = to;
      if (from < n + 1) sum = least_sum(from);
    }
  }
  least_sum(1000);
  EXPECT_LE(most_bound, c_most * (1 + 1e-12));
  // docs/accuracy.md states the worst exponent, its error and its fit.
  EXPECT_NEAR(worst.total(), 4.92, 0.005);
  EXPECT_NEAR(worst_exponent, 2.65, 0.005);
  EXPECT_NEAR(worst.fit, 3.14, 0.005);
  const PowerParts& of_power = power_parts(fitted_bell(worst_exponent).power);
  EXPECT_NEAR(of_power.table, 1.00, 0.005);
  EXPECT_NEAR(of_power.drift, 0.25, 0.005);
}

// The colour by the shader's arithmetic: the angle's word, off by the drift and rounded within it, the entry
// of the table, the product with the factor, and rounding. Angles are in half bells.
std::int64_t drawn_colour(const tables::CosineTable& table, double half_bells, double drift,
                          std::int64_t factor) {
  constexpr int c_fraction = 22;
  const std::int64_t unit = std::int64_t{1} << c_fraction;
  const double word_real = (half_bells + drift) * double(unit);
  const auto word = static_cast<std::int64_t>(drift < 0 ? std::ceil(word_real) : std::floor(word_real));
  const std::int64_t magnitude = word < 0 ? ~word : word;
  const std::int64_t sample =
      magnitude < unit
          ? table.entries[static_cast<std::size_t>(magnitude * table.size.entries() >> c_fraction)]
          : 0;
  const std::int64_t half = std::int64_t{1} << (7 + table.size.data_bits);
  return std::min<std::int64_t>(255, (half + factor * sample) >> (8 + table.size.data_bits));
}

/// The largest error of colours by the shader's arithmetic at angles up to `farthest`, including angles that
/// have drifted. Each is within the sum of the parts.
double largest_error(double n, const tables::CosineTable& table, double half_bells_per_radian, double gain,
                     double farthest, double most_drift, const Parts& bound, RandomScenes& random) {
  const std::int64_t largest = table.size.largest_entry();
  const std::int64_t factor = std::llround(c_steps * gain * 256.0 * double(largest + 1) / double(largest));
  double worst = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double x = std::min(c_pi, random.within(-1.0, 1.0) * farthest);
    // Anywhere within the drift, often at its limits.
    const double drift = most_drift * std::clamp(random.within(-2.0, 2.0), -1.0, 1.0);
    const std::int64_t colour = drawn_colour(table, half_bells_per_radian * x, drift, factor);
    const double error = std::abs(double(colour) - c_steps * lobe(n, std::abs(x)));
    worst = std::max(worst, error);
    EXPECT_LE(error, bound.total()) << "n = " << n << ", x = " << x << ", drift " << drift << ": " << bound;
  }
  return worst;
}

TEST(Bell, ColoursStayWithinTheSumOfTheParts) {
  RandomScenes random(4);
  std::vector<double> exponents = {1.0, 2.0, 2.5, 2.646, 2.649, 3.0, 5.0, 16.0, 1000.0, 1e6};
  for (int i = 0; i < 40; ++i) exponents.push_back(random.log_within(1.0, 1e6));
  double nearest = 0.0;
  for (const double n : exponents) {
    const Bell bell = fitted_bell(n);
    const Parts bound = parts(n, bell);
    const double farthest = 1.2 * std::max(c_pi / (2 * bell.scale), 2 / std::sqrt(n));
    const double worst = largest_error(n, tables::cosine_table(true, bell.power, c_size),
                                       bell.scale / (c_pi / 2), bell.gain, farthest, c_drift, bound, random);
    nearest = std::max(nearest, worst / bound.total());
  }
  EXPECT_GT(nearest, 0.8) << "the bound is far from what is seen";
}

// ---- own tables

/// Drift of an angle word whose rounding is centred on a span of 4096 pixels (centred_start), in half bells.
constexpr double c_own_drift = (1 + 4095 / 2.0) * 0x1p-23;

/// Own tables need no fitted bell. Every part but `drift` and `table` is that of fitted bells.
Parts own_parts(const tables::CosineTable& table, double steepest_slope) {
  return {0.0, c_steps * tables::error_bound(table), c_steps * c_own_drift * steepest_slope};
}

/// The greatest slope of cos^n over an own table, with respect to the table's end.
double own_steepest(double from, double to) {
  // For all n in [from, to]: reach and (1 - 1/n)^((n - 1)/2) decrease with n, the root increases.
  return tables::own_reach(from) * std::sqrt(to) * std::pow(1 - 1 / from, (from - 1) / 2);
}

/// The greatest slope closer to an own table's end than the drift: cos^n is at most `value` there.
double own_steepest_at_end(double from, double to, double value) {
  const double reach = tables::own_reach(from);
  return to * reach * std::min(1.0, reach) * std::pow(value, 1 - 1 / from);
}

// For every n from 1 to the largest exponent, not only for the tested ones: the parts depend on n only by
// slopes, which are bounded on intervals of n. Where the word is beyond the table's end, the colour is 0 and
// cos^n at most c_own_end plus the drift.
TEST(OwnTable, EveryExponentIsWithinOneStep) {
  const tables::CosineSize size = tables::c_own_size;
  const double half_word = 0.5 / (size.largest_entry() + 1), half_cell = 0.5 / size.entries();
  constexpr double c_step = 1.001;
  double steepest_slope = 0.0, at = 0.0, at_end = 0.0;
  for (double from = 1.0; from < 1e6; from *= c_step)
    if (const double slope = own_steepest(from, c_step * from); slope > steepest_slope)
      steepest_slope = slope, at = from;
  for (double from = 1.0; from < 1e6; from *= c_step)
    at_end = std::max(
        at_end, own_steepest_at_end(from, c_step * from, tables::c_own_end + c_own_drift * steepest_slope));
  const Parts all{0.0, c_steps * (half_word * (1 + 0x1p-10) + half_cell * steepest_slope),
                  c_steps * c_own_drift * steepest_slope};
  EXPECT_LE(all.total(), 1.0) << all << " at n = " << at;
  EXPECT_LE(c_steps * (tables::c_own_end + c_own_drift * at_end) + all.factor + all.rounding, 1.0);
  // Diffuse light: the cosine of the same size, with the slope pi/2.
  const double diffuse = c_steps * (tables::error_bound(tables::cosine_table(true, 1, tables::c_own_size)) +
                                    c_own_drift * c_pi / 2) +
                         all.factor + all.rounding;
  EXPECT_NEAR(diffuse, 0.86, 0.005);
  // docs/accuracy.md lists the parts.
  EXPECT_NEAR(all.total(), 0.99, 0.005);
  EXPECT_NEAR(all.table, 0.34, 0.005);
  EXPECT_NEAR(all.drift, 0.14, 0.005);
}

TEST(OwnTable, ColoursStayWithinOneStep) {
  RandomScenes random(5);
  std::vector<double> exponents = {1.0, 1.305, 2.0, 2.65, 3.0, 5.0, 6.0, 16.0, 20.0, 50.0, 1000.0, 1e6};
  for (int i = 0; i < 30; ++i) exponents.push_back(random.log_within(1.0, 1e6));
  double worst = 0.0;
  for (const double n : exponents) {
    const double reach = tables::own_reach(n);
    const tables::CosineTable table = tables::own_table(n, 2, tables::c_own_size);
    worst = std::max(worst, largest_error(n, table, 1.0 / reach, 1.0, 1.1 * reach, c_own_drift,
                                          own_parts(table, own_steepest(n, n)), random));
  }
  EXPECT_LE(worst, 1.0);
  EXPECT_GT(worst, 0.85) << "the bound is far from what is seen";
}

}  // namespace
}  // namespace halfway

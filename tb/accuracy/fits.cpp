// SPDX-License-Identifier: Apache-2.0
// Rows of the ways to approximate cos^n by tables of the spherical shader: the largest error of the fit
// alone, for exponents from 2 to 1000. Fits are searched, so the errors are upper bounds of the best ones,
// close to them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "accuracy/row.hpp"
#include "shading/bell.hpp"

namespace halfway::accuracy {
namespace {

using page::Fields;

constexpr double c_steps = 255.0, c_largest = 1000.0;
constexpr std::size_t c_samples = 160;
using Samples = std::array<double, c_samples>;

// cos^m u, zero beyond pi/2.
double cosine(double m, double u) {
  return u < std::numbers::pi / 2 ? std::pow(std::cos(u), m) : 0.0;
}

// `f` at equal steps over a highlight of exponent n.
Samples sampled(double n, const std::function<double(double)>& f) {
  const double end = std::min(std::numbers::pi / 2, 5.0 / std::sqrt(n));
  Samples samples;
  for (std::size_t i = 0; i < c_samples; ++i) samples[i] = f(end * static_cast<double>(i) / (c_samples - 1));
  return samples;
}

// Least largest |truth - p a - q b|, in units of 1, by Lawson's iteration: least squares, weighted by the
// errors of the last round. `positive`: only p, q >= 0.
double two_terms(const Samples& truth, const Samples& a, const Samples& b, bool positive) {
  constexpr int c_rounds = 25;
  Samples weight;
  weight.fill(1.0);
  double least = 1.0;
  for (int round = 0; round < c_rounds; ++round) {
    double aa = 0, ab = 0, bb = 0, ta = 0, tb = 0;
    for (std::size_t i = 0; i < c_samples; ++i) {
      aa += weight[i] * a[i] * a[i], ab += weight[i] * a[i] * b[i], bb += weight[i] * b[i] * b[i];
      ta += weight[i] * truth[i] * a[i], tb += weight[i] * truth[i] * b[i];
    }
    const double determinant = aa * bb - ab * ab;
    if (!(determinant > 1e-12 * aa * bb)) break;
    const double p = (ta * bb - tb * ab) / determinant, q = (tb * aa - ta * ab) / determinant;
    double largest = 0, sum = 0;
    for (std::size_t i = 0; i < c_samples; ++i) {
      const double error = std::abs(truth[i] - p * a[i] - q * b[i]);
      largest = std::max(largest, error);
      sum += weight[i] *= error + 1e-12;
    }
    for (double& w : weight) w *= c_samples / sum;
    if (!positive || (p >= 0 && q >= 0)) least = std::min(least, largest);
  }
  return least;
}

// The least of f near `at`: steps in all directions, halved when none helps.
double least_near(std::array<double, 2> at, double step, const std::function<double(double, double)>& f) {
  double least = f(at[0], at[1]);
  while (step > 1e-4) {
    const auto here = at;
    for (const int u : {-1, 0, 1})
      for (const int v : {-1, 0, 1})
        if (const double found = f(here[0] * (1 + u * step), here[1] * (1 + v * step)); found < least)
          least = found, at = {here[0] * (1 + u * step), here[1] * (1 + v * step)};
    if (at == here) step /= 2;
  }
  return least;
}

// The least of f between two places: at equal steps, then by ternary search between the neighbours of the
// best.
template <class Function>
double least_between(double low, double high, const Function& f) {
  constexpr int c_steps_between = 14, c_rounds = 14;
  const double step = (high - low) / c_steps_between;
  double least = f(low), at = low;
  for (int i = 1; i <= c_steps_between; ++i)
    if (const double found = f(low + i * step); found < least) least = found, at = low + i * step;
  double from = at - step, to = at + step;
  for (int round = 0; round < c_rounds; ++round) {
    const double third = (to - from) / 3, left = f(from + third), right = f(to - third);
    least = std::min({least, left, right});
    (left < right ? to : from) = left < right ? to - third : from + third;
  }
  return least;
}

// Two bells with angles and factors of their own: two specular slices. The error has a narrow valley along
// the widths of both, so the best width of one is searched for each width of the other.
double sum_of_two_bells(double n) {
  constexpr std::array c_powers = {1, 2, 4, 8, 16};
  constexpr double c_narrowest = 0.6, c_widest = 2.4;  // relative to the bell with the highlight's curvature
  const Samples truth = sampled(n, [&](double x) { return cosine(n, x); });
  const auto bell = [&](int power, double width) {
    return sampled(n, [&](double x) { return cosine(power, width * std::sqrt(n / power) * x); });
  };
  double least = 1.0;
  for (const int first : c_powers)
    for (const int second : c_powers) {
      // Much steeper bells than the highlight are of no use.
      if (second < first || second > 8 * n) continue;
      const double of_pair = least_between(c_narrowest, c_widest, [&](double t) {
        const Samples other = bell(second, t);
        return least_between(c_narrowest, c_widest,
                             [&](double s) { return two_terms(truth, bell(first, s), other, true); });
      });
      least = std::min(least, of_pair);
    }
  return least;
}

// One angle, two tables and a weight for each material. Exponents and widths of the tables are the result of
// a random search over all exponents.
double two_tables(double n) {
  constexpr double c_wide = 2.378, c_narrow = 11.143, c_ratio = 1.1603;
  const Samples truth = sampled(n, [&](double x) { return cosine(n, x); });
  const auto error = [&](double s, double) {
    return two_terms(
        truth, sampled(n, [&](double x) { return cosine(c_wide, s * x / std::sqrt(c_wide)); }),
        sampled(n, [&](double x) { return cosine(c_narrow, c_ratio * s * x / std::sqrt(c_narrow)); }), false);
  };
  double least = 1.0;
  for (const double start : {0.8, 0.9, 1.0, 1.1})
    least = std::min(least, least_near({start * std::sqrt(n), 1.0}, 0.03, error));
  return least;
}

// Bells of one table with any power m: the least error of cos^n.
double one_table(double n, double m) {
  const Samples truth = sampled(n, [&](double x) { return cosine(n, x); });
  const auto error = [&](double s, double gain) {
    const Samples bell = sampled(n, [&](double x) { return gain * cosine(m, s * x); });
    double largest = 0;
    for (std::size_t i = 0; i < c_samples; ++i) largest = std::max(largest, std::abs(truth[i] - bell[i]));
    return largest;
  };
  return least_near({std::sqrt(n / m), 1.0}, 0.02, error);
}

// Fewest powers such that every exponent has a bell within `most` steps: each power reaches as far as
// possible.
int powers_within(double most) {
  const auto fits = [&](double n, double m) { return c_steps * one_table(n, m) <= most; };
  const auto last = [](double from, double to, const auto& holds) {
    for (int i = 0; i < 12; ++i) (holds(std::sqrt(from * to)) ? from : to) = std::sqrt(from * to);
    return from;
  };
  int count = 0;
  for (double n = 2.0; n < c_largest; ++count) {
    const double m = last(n, c_largest, [&](double power) { return fits(n, power); });
    n = fits(c_largest, m) ? c_largest
                           : last(m, c_largest, [&](double exponent) { return fits(exponent, m); });
  }
  return count;
}

struct Worst {
  double error = 0, exponent = 0;
};

Worst worst(const std::function<double(double)>& error) {
  Worst found;
  for (double n = 2.0; n <= c_largest; n *= n < 8.0 ? 1.02 : 1.2)
    if (const double here = c_steps * error(n); here > found.error) found = {here, n};
  return found;
}

struct Fit {
  std::string highlight;
  Worst worst;
};

Row row(const std::string& id, const std::string& hardware, const std::function<Fit()>& fit) {
  return {.id = id, .measure = [=]() -> Fields {
            const auto [highlight, worst] = fit();
            return {{"highlight", highlight},
                    {"hardware for each light", hardware},
                    {"largest error of the fit", fmt::format("{:.2f}", worst.error)},
                    {"at exponent", worst.exponent > 0 ? fmt::format("{:.3g}", worst.exponent) : "–"},
                    {"with the colour's rounding", fmt::format("{:.2f}", worst.error + 0.5)}};
          }};
}

}  // namespace

std::vector<Row> fit_rows() {
  const std::string of_powers = "a table for each power in use";
  return {row("powers", of_powers,
              [] {
                return Fit{"one bell of cos, cos², cos⁴, cos⁸ or cos¹⁶ (default)",
                           worst([](double n) { return fit_error(n, fitted_bell(n)); })};
              }),
          row("more_powers", of_powers,
              [] {
                constexpr double c_fit = 0.25;
                return Fit{fmt::format("one bell of {} powers, chosen for this error", powers_within(c_fit)),
                           {c_fit, 0.0}};
              }),
          row("two_bells", "a second specular slice, and its words in line records",
              [] {
                return Fit{"sum of two bells, an angle each", worst(sum_of_two_bells)};
              }),
          row("two_tables", "a second table and a product of table entry and weight",
              [] {
                return Fit{"two tables of one angle, blended by a weight", worst(two_tables)};
              }),
          row("own", "a table for each exponent in use", [] {
            return Fit{"own tables: cosⁿ itself", {}};
          })};
}

}  // namespace halfway::accuracy

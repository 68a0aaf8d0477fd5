// SPDX-License-Identifier: Apache-2.0
#include "common/sine_cosine.hpp"

#include <cmath>
#include <cstdint>

#include "common/to_integer.hpp"

namespace halfway {
namespace {

/// The sum of two doubles, the second at most half a unit in the last place of the first.
struct Pair {
  double high, low;
};

/// a + b without error (Knuth).
Pair exact_sum(double a, double b) {
  const double sum = a + b, other = sum - a;
  return {sum, (a - (sum - other)) + (b - other)};
}

/// a * b without error (Dekker).
Pair exact_product(double a, double b) {
  constexpr double c_splitter = 134217729.0;  // 2^27 + 1
  const auto upper = [](double x) {
    const double scaled = c_splitter * x;
    return scaled - (scaled - x);
  };
  const double a1 = upper(a), a2 = a - a1, b1 = upper(b), b2 = b - b1, product = a * b;
  return {product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2};
}

Pair operator+(const Pair& a, const Pair& b) {
  const Pair sum = exact_sum(a.high, b.high);
  return exact_sum(sum.high, sum.low + (a.low + b.low));
}

Pair operator*(const Pair& a, const Pair& b) {
  const Pair product = exact_product(a.high, b.high);
  return exact_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

Pair operator/(const Pair& a, double divisor) {
  const double quotient = a.high / divisor;
  const Pair back = exact_product(quotient, divisor);
  return exact_sum(quotient, ((a.high - back.high) - back.low + a.low) / divisor);
}

/// 1 - s/(n (n+1)) (1 - s/((n+2) (n+3)) (1 - ...)): the cosine of the root of s for n = 1, its sine divided
/// by the root for n = 2. Terms after the last are below 2^-100 for angles up to pi/4.
Pair series(const Pair& square, int n) {
  constexpr int c_last = 28;
  Pair sum{1.0, 0.0};
  const Pair negative{-square.high, -square.low};
  for (int i = n + c_last; i >= n; i -= 2) sum = Pair{1.0, 0.0} + negative * sum / (i * (i + 1.0));
  return sum;
}

}  // namespace

SineCosine sine_cosine(double radians) {
  // Subtract quarter turns. The first two parts of pi/2 have 33 bits, so their products are exact.
  constexpr double c_part1 = 0x1.921fb544p0, c_part2 = 0x1.0b4611a6p-34, c_part3 = 0x1.3198a2e037073p-69;
  const double quarters = std::rint(radians / (c_part1 + c_part2));
  const Pair rest =
      exact_sum(radians, -quarters * c_part1) + exact_sum(-quarters * c_part2, -quarters * c_part3);
  const Pair square = rest * rest;
  const double sine = (rest * series(square, 2)).high, cosine = series(square, 1).high;
  switch (to_integer<std::int64_t>(quarters) & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// The power rises with its base; the published one has the paper's errors. The spot's factor is its cubic,
// with the bound stated in the header in rtl/. tb/specification/bounds bounds the error of the power.
#include "golden/power.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "golden/spot_cone.hpp"

namespace halfway::golden {
namespace {

template <class Preset>
long double power_error(std::uint32_t base, std::uint32_t exponent) {
  using P = Power<Preset>;
  const long double c = std::ldexp(static_cast<long double>(base), -P::c_base_fraction),
                    m = std::ldexp(static_cast<long double>(exponent), -Preset::c_exponent_fraction_bits);
  return std::ldexp(static_cast<long double>(P::power(base, exponent)), -Preset::c_weight_fraction_bits) -
         std::pow(c, m);
}

// The power is monotonic in its base: no rings around a highlight.
TEST(Power, RisesWithItsBase) {
  for (const std::uint32_t m : {1U, 5U, 50U, 500U}) {
    for (std::uint32_t base = 1; base <= Power<Published>::c_one; ++base)
      ASSERT_GE(Power<Published>::power(base, m), Power<Published>::power(base - 1, m)) << base << ", " << m;
    for (std::uint32_t base = 1; base <= Power<Exact>::c_one; ++base)
      ASSERT_GE(Power<Exact>::power(base, m << 8), Power<Exact>::power(base - 1, m << 8))
          << base << ", " << m;
  }
}

// Cells of 1/64 of a power of two: the kind of table in the paper, and its errors in sharp highlights.
TEST(Power, ErrorsOfPresetPublished) {
  for (const auto& [m, expected] :
       {std::pair{1U, 1.99}, {10U, 9.81}, {50U, 45.04}, {100U, 83.12}, {500U, 213.47}}) {
    long double largest = 0;
    for (std::uint32_t base = 0; base <= Power<Published>::c_one; ++base)
      largest = std::max(largest, std::fabs(power_error<Published>(base, m)));
    EXPECT_NEAR(static_cast<double>(255 * largest), expected, 0.005) << m;
  }
}

// Slopes up to 2^whole_bits.
template <class Preset>
void expect_spot(double bound, int whole_bits = 12) {
  constexpr int c_fraction = Preset::c_direction_fraction_bits;
  std::mt19937_64 random(2);
  long double largest = 0;
  for (int i = 0; i < 300'000; ++i) {
    const int slope_bits = whole_bits + Preset::c_spot_slope_fraction_bits;
    const auto slope =
        static_cast<std::uint32_t>(1 + (random() % ((1ULL << slope_bits) - 1) >> random() % slope_bits));
    const auto outer = static_cast<std::int64_t>(random() % (2ULL << c_fraction)) - (1LL << c_fraction);
    const long double s = std::ldexp(static_cast<long double>(slope), -Preset::c_spot_slope_fraction_bits);
    // From slightly outside the outer edge to slightly inside the inner edge.
    const long double wanted = (static_cast<long double>(random() % 1'000'000) / 800'000 - 0.1L) / s;
    const auto over = static_cast<std::int64_t>(std::ldexp(std::min(wanted, 2.0L), 2 * c_fraction));
    const std::int64_t sum = -(outer * (std::int64_t{1} << c_fraction)) - over;
    const long double t =
        std::clamp(std::ldexp(static_cast<long double>(over), -2 * c_fraction) * s, 0.0L, 1.0L);
    const std::uint32_t factor = SpotCone<Preset>::factor(sum, outer, slope);
    const long double error =
        std::ldexp(static_cast<long double>(factor), -Preset::c_weight_fraction_bits) - t * t * (3 - 2 * t);
    largest = std::max(largest, std::fabs(error));
    if (t == 0) {
      ASSERT_EQ(factor, 0U);
    }
    if (t == 1) {
      ASSERT_EQ(factor, 1U << Preset::c_weight_fraction_bits);
    }
  }
  EXPECT_LT(largest, bound);
  EXPECT_GT(largest, 0.6L * bound);
}

// Truncation of t is at most one step, that of `over` at most 2^-28. The cubic's slope is at most 3/2, and
// its result is rounded.
TEST(SpotCone, IsTheCubic) {
  expect_spot<Exact>(std::ldexp(3.5, -16));
  expect_spot<Published>(std::ldexp(2.0, -8));
  // Steeper edges.
  constexpr int c_steepest = Exact::c_spot_slope_bits - Exact::c_spot_slope_fraction_bits;
  expect_spot<Exact>(std::ldexp(3.5, -16) + std::ldexp(1.5, c_steepest - 28), c_steepest);
}

}  // namespace
}  // namespace halfway::golden

// SPDX-License-Identifier: Apache-2.0
// The power rises with its base; the published one has the paper's errors. tb/specification/bounds bounds the
// errors of the power and of the spot's factor.
#include "golden/power.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

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

}  // namespace
}  // namespace halfway::golden

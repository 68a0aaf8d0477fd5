// SPDX-License-Identifier: Apache-2.0
// Conversions of any double, compared with the exact integers of GMP.
#include "common/to_integer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include "common/test/gmp_numbers.hpp"

namespace halfway {
namespace {

template <class Integer>
class ToInteger : public testing::Test {
 protected:
  // The integer part, clamped to Integer.
  static mpz_class expected(double v) {
    using Range = std::numeric_limits<Integer>;
    const mpz_class least = to_mpz(Range::min()), most = Range::digits == 127
                                                             ? mpz_class((mpz_class(1) << 127) - 1)
                                                             : to_mpz(static_cast<Int128>(Range::max()));
    if (std::isnan(v)) return 0;
    if (std::isinf(v)) return v > 0 ? most : least;
    return std::clamp(mpz_class(v), least, most);
  }
  static void expect_clamped(double v) {
    ASSERT_EQ(to_mpz(Int128{to_integer<Integer>(v)}), expected(v)) << v;
  }
};

using Integers = testing::Types<int, std::uint8_t, std::uint32_t, std::int64_t, std::uint64_t, Int128>;
TYPED_TEST_SUITE(ToInteger, Integers);

TYPED_TEST(ToInteger, ClampsAndNanIsZero) {
  std::mt19937_64 random(31);
  for (int i = 0; i < 50'000; ++i) this->expect_clamped(std::bit_cast<double>(random()));
  for (int bits = 0; bits <= 130; ++bits)
    for (const double power : {std::ldexp(1.0, bits), std::ldexp(-1.0, bits)})
      for (const double towards : {power, -HUGE_VAL, HUGE_VAL})
        this->expect_clamped(std::nextafter(power, towards));
  for (const double v : {0.0, -0.0, 0.5, -0.5, 5e-324, -1e-310, 1e308, -1e308, HUGE_VAL, -HUGE_VAL})
    this->expect_clamped(v);
  this->expect_clamped(std::nan(""));
}

}  // namespace
}  // namespace halfway

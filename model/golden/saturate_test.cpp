// SPDX-License-Identifier: Apache-2.0
// Compares saturation with GMP's integers, for every word of 16 bits.
#include "golden/saturate.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace halfway::golden {
namespace {

template <int FractionBits, int ResultBits>
void expect_saturates() {
  for (std::int64_t v = -32768; v <= 32767; ++v) {
    const auto result =
        saturate<16, FractionBits, ResultBits>(Word<16>::from_bits(static_cast<std::uint64_t>(v)));
    mpz_class whole;
    mpz_fdiv_q_2exp(whole.get_mpz_t(), mpz_class(static_cast<long>(v)).get_mpz_t(), FractionBits);
    const long expected = std::clamp(whole.get_si(), 0L, (1L << ResultBits) - 1);
    ASSERT_EQ(long{result}, expected) << v << " with " << FractionBits << " fraction bits";
  }
}

TEST(Saturate, EverySixteenBitWord) {
  expect_saturates<0, 8>();
  expect_saturates<4, 8>();
  expect_saturates<6, 8>();
  expect_saturates<0, 14>();
  expect_saturates<13, 1>();
  expect_saturates<10, 4>();
}

}  // namespace
}  // namespace halfway::golden

// SPDX-License-Identifier: Apache-2.0
// Compares ExactDivider with GMP's integers.
#include "common/exact_division.hpp"

#include <gtest/gtest.h>

#include <random>

#include "common/test/gmp_numbers.hpp"

namespace halfway {
namespace {

mpz_class expected(Int128 numerator, Int128 divisor) {
  return rounded(mpq_class(to_mpz(numerator), to_mpz(divisor)));
}

constexpr Int128 c_one = 1;
constexpr Int128 c_most = (c_one << 125) - 1;  // largest numerator
constexpr Int128 c_most_divisor = (c_one << 96) - 1;

class RandomIntegers {
 public:
  explicit RandomIntegers(unsigned seed) : random_(seed) {}
  /// A number of exactly `bits` bits; 0 for 0 bits.
  Int128 of_bits(int bits) {
    if (bits == 0) return 0;
    const Int128 v = (static_cast<Int128>(random_()) << 64) | random_();
    return (v & ((c_one << (bits - 1)) - 1)) | (c_one << (bits - 1));
  }
  /// Every size has the same probability.
  Int128 up_to_bits(int bits) { return of_bits(within(0, bits)); }
  int within(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

 private:
  std::mt19937_64 random_;
};

TEST(ExactDivider, RoundsRandomQuotientsAsGmpDoes) {
  RandomIntegers random(1);
  for (int i = 0; i < 100'000; ++i) {
    const Int128 divisor = random.of_bits(random.within(1, 96));
    const Int128 numerator = random.up_to_bits(125) * (i % 2 ? 1 : -1);
    ASSERT_EQ(to_mpz(ExactDivider(divisor).rounded(numerator)), expected(numerator, divisor))
        << to_mpz(numerator).get_str() << " / " << to_mpz(divisor).get_str();
  }
}

TEST(ExactDivider, RoundsHalvesUpAndTheirNeighboursToTheirOwnSide) {
  RandomIntegers random(2);
  for (int i = 0; i < 50'000; ++i) {
    const int bits = random.within(1, 96);
    const Int128 divisor = random.of_bits(bits);
    const Int128 whole = random.up_to_bits(124 - bits) * (i % 2 ? 1 : -1);
    const ExactDivider divider(divisor);
    for (const Int128 from_half : {-2, -1, 0, 1, 2})
      for (const Int128 at :
           {whole * divisor, whole * divisor + divisor / 2, whole * divisor - divisor / 2}) {
        const Int128 numerator = at + from_half;
        ASSERT_EQ(to_mpz(divider.rounded(numerator)), expected(numerator, divisor))
            << to_mpz(numerator).get_str() << " / " << to_mpz(divisor).get_str();
      }
  }
  EXPECT_EQ(ExactDivider(2).rounded(5), 3);
  EXPECT_EQ(ExactDivider(2).rounded(-5), -2);
}

TEST(ExactDivider, HoldsAtTheEndsOfItsRange) {
  std::vector<Int128> divisors = {1, 2, 3, 5, c_most_divisor, c_most_divisor - 1, c_one << 95};
  std::vector<Int128> numerators = {0, 1, 2, c_most, c_most - 1, c_one << 124, (c_one << 124) + 1};
  for (int bit = 1; bit < 96; ++bit)
    for (const Int128 off : {-1, 0, 1}) divisors.push_back((c_one << bit) + off);
  for (int bit = 1; bit < 125; ++bit)
    for (const Int128 off : {-1, 0, 1}) numerators.push_back((c_one << bit) + off);
  for (const Int128 divisor : divisors) {
    const ExactDivider divider(divisor);
    for (const Int128 numerator : numerators)
      for (const Int128 n : {numerator, -numerator})
        ASSERT_EQ(to_mpz(divider.rounded(n)), expected(n, divisor))
            << to_mpz(n).get_str() << " / " << to_mpz(divisor).get_str();
  }
}

}  // namespace
}  // namespace halfway

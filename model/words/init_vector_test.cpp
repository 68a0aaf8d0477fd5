// SPDX-License-Identifier: Apache-2.0
// Rounding, places of fields, and the drift of a word along a span whose start is centred.
#include "words/init_vector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "common/test/gmp_numbers.hpp"

namespace halfway {
namespace {

constexpr int c_word_fraction = 22, c_word_bits = 33;

// The largest error of the rounded start plus k rounded slopes, in units of the word.
double drift(double start, double slope, std::int64_t steps, double centred) {
  const std::int64_t word = wrapped_word(centred, c_word_fraction, c_word_bits),
                     step = wrapped_word(slope, c_word_fraction, c_word_bits);
  double largest = 0.0;
  for (std::int64_t k = 0; k <= steps; ++k)
    largest =
        std::max(largest, std::abs(static_cast<double>(word + k * step) -
                                   std::ldexp(start + static_cast<double>(k) * slope, c_word_fraction)));
  return largest;
}

TEST(CentredStart, HalvesTheDrift) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> real(-1.0, 1.0);
  double centred = 0.0, plain = 0.0;
  for (int i = 0; i < 300; ++i) {
    const std::int64_t steps = i % 3 == 0 ? 4095 : i;
    const double start = real(random), slope = real(random) * 1e-3;
    const double bound = (1 + static_cast<double>(steps) / 2) / 2;
    const double found = drift(start, slope, steps, centred_start(start, slope, steps, c_word_fraction));
    EXPECT_LE(found, bound * (1 + 1e-6)) << start << ' ' << slope << ' ' << steps;
    centred = std::max(centred, found / bound);
    plain = std::max(plain, drift(start, slope, steps, start) / bound);
  }
  EXPECT_GT(centred, 0.95);
  EXPECT_GT(plain, 1.8) << "a start that is not centred drifts as far";
}

TEST(CentredStart, IsTheStartOfASinglePixel) {
  EXPECT_EQ(centred_start(0.3, 0.1, 0, c_word_fraction), 0.3);
}

TEST(InitVector, NearestRoundsAsTheLibraryDoes) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> size(-3.0, 17.5), sign(-1.0, 1.0);
  const auto expect_same = [](double value) {
    ASSERT_EQ(nearest(value), to_integer<std::int64_t>(std::round(value))) << value;
  };
  for (int i = 0; i < 1'000'000; ++i) {
    const double value = std::copysign(std::pow(10.0, size(random)), sign(random));
    expect_same(value);
    for (const double half : {std::trunc(value) + 0.5, std::trunc(value) - 0.5})
      for (const double towards : {-1e300, 0.0, 1e300}) {
        expect_same(half);
        expect_same(std::nextafter(half, towards));
      }
  }
  for (const double value :
       {0.0, -0.0, 0x1p51 + 0.5, 0x1p52 + 1.0, 0x1p53, 1e300, -1e300, std::numeric_limits<double>::infinity(),
        std::numeric_limits<double>::quiet_NaN()})
    expect_same(value);
}

TEST(InitVector, WrappedWordsAreModuloTheirWidth) {
  std::mt19937_64 random(31);
  const auto expect_congruent = [](double v) {
    for (const int fraction : {0, 8, 20, 22})
      for (const int bits : {12, 32, 40}) {
        const double scaled = std::ldexp(v, fraction);
        // Above 2^1023 a number is a multiple of every modulus.
        mpz_class off = to_mpz(wrapped_word(v, fraction, bits));
        if (std::isfinite(scaled)) off -= mpz_class(std::nearbyint(scaled));
        mpz_fdiv_r_2exp(off.get_mpz_t(), off.get_mpz_t(), static_cast<mp_bitcnt_t>(bits));
        ASSERT_EQ(off, 0) << v << " in " << bits << " bits, fraction " << fraction;
      }
  };
  for (int i = 0; i < 20'000; ++i) expect_congruent(std::bit_cast<double>(random()));
  for (const double v : {0x1p63, -0x1p63, 0x1p64, 1e300, std::numeric_limits<double>::infinity(),
                         std::numeric_limits<double>::quiet_NaN()})
    expect_congruent(v);
}

// Fields of 1 to 64 bits one after the other, from any bit on, against words::set_bits.
TEST(InitVector, PutsFieldsWhereTheGoldenModelReadsThem) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 2'000; ++i) {
    std::vector<std::uint32_t> words;
    constexpr unsigned c_vector_bits = 1024;
    InitVector init(words, c_vector_bits);
    std::vector<std::uint32_t> expected(c_vector_bits / 32);
    for (int low = static_cast<int>(random() % 40); low + 64 < static_cast<int>(c_vector_bits);) {
      const words::Field field{"", 7, static_cast<int>(1 + random() % 64), false, 0};
      const std::uint64_t value = random();
      init.put(field, static_cast<std::int64_t>(value), low - 7);
      words::set_bits(expected, field, value, low - 7);
      low += field.bits;
    }
    ASSERT_EQ(words, expected);
  }
}

}  // namespace
}  // namespace halfway

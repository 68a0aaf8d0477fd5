// SPDX-License-Identifier: Apache-2.0
// Compares Word's sums with GMP's integers modulo 2^W. Tests fields of flat vectors at every alignment.
#include "words/word.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <utility>

namespace halfway::words {
namespace {

/// v modulo 2^bits, in [-2^(bits-1), 2^(bits-1)).
mpz_class wrapped(const mpz_class& v, int bits) {
  const mpz_class modulus = mpz_class(1) << bits, half = mpz_class(1) << (bits - 1);
  mpz_class r;
  mpz_fdiv_r(r.get_mpz_t(), mpz_class(v + half).get_mpz_t(), modulus.get_mpz_t());
  return r - half;
}

template <int W>
void expect_sums_wrap(std::mt19937_64& random) {
  const auto any_bits = [&] {
    switch (random() % 4) {
      case 0:
        return std::uint64_t{1} << (W - 1);  // the least word
      case 1:
        return (std::uint64_t{1} << (W - 1)) - 1;  // the greatest
      default:
        return random();
    }
  };
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t first = any_bits();
    Word<W> word = Word<W>::from_bits(first);
    ASSERT_EQ(word.bits(), low_bits(first, W));
    mpz_class sum = wrapped(mpz_class(static_cast<unsigned long>(first)), W);
    ASSERT_EQ(mpz_class(static_cast<long>(word.value())), sum) << W;
    for (int j = 0; j < 10; ++j) {
      const Word<W> increment = Word<W>::from_bits(any_bits());
      ASSERT_EQ(word + increment, increment + word);
      word += increment;
      sum += static_cast<long>(increment.value());
      ASSERT_EQ(mpz_class(static_cast<long>(word.value())), wrapped(sum, W)) << W;
      ASSERT_EQ(word, Word<W>::from_bits(word.bits()));
      ASSERT_EQ(word, Word<W>::from_bits(static_cast<std::uint64_t>(word.value())));
    }
  }
}

TEST(Word, SumsWrapAtEveryWidth) {
  std::mt19937_64 random(1);
  [&]<int... Zero>(std::integer_sequence<int, Zero...>) {
    (expect_sums_wrap<Zero + 1>(random), ...);
  }(std::make_integer_sequence<int, 64>());
}

TEST(Word, LowBitsKeepsTheLowestBits) {
  for (int bits = 1; bits <= 64; ++bits) {
    const mpz_class modulus = mpz_class(1) << bits;
    for (std::uint64_t v : {~std::uint64_t{0}, std::uint64_t{0x0123456789abcdef}, std::uint64_t{1} << 63})
      ASSERT_EQ(mpz_class(static_cast<unsigned long>(low_bits(v, bits))),
                mpz_class(static_cast<unsigned long>(v)) % modulus);
  }
}

// Every width at every alignment within two words, on a random vector: the field has the value, and no other
// bit of the vector changes.
TEST(FlatVector, AFieldIsWrittenAndReadAtEveryAlignment) {
  std::mt19937_64 random(2);
  constexpr int c_words = 6;
  for (int bits = 1; bits <= 64; ++bits)
    for (int low = 0; low + bits <= 32 * c_words; ++low)
      for (int block_low : {0, low / 2, low}) {
        std::array<std::uint32_t, c_words> words, before;
        for (std::uint32_t& word : words) word = static_cast<std::uint32_t>(random());
        before = words;
        const Field field{"field", low - block_low, bits, false, 0};
        const std::uint64_t value = random();
        set_bits(words, field, value, block_low);
        ASSERT_EQ(get_bits(words, field, block_low), low_bits(value, bits)) << bits << " bits at " << low;
        for (int i = 0; i < 32 * c_words; ++i) {
          const bool is = words[static_cast<std::size_t>(i) / 32] >> (i % 32) & 1;
          const bool was = before[static_cast<std::size_t>(i) / 32] >> (i % 32) & 1;
          const bool should = i >= low && i < low + bits ? (value >> (i - low) & 1) != 0 : was;
          ASSERT_EQ(is, should) << bits << " bits at " << low << ", bit " << i;
        }
      }
}

}  // namespace
}  // namespace halfway::words

// SPDX-License-Identifier: Apache-2.0
#include "mesh_files/number.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <utility>

namespace halfway {
namespace {

TEST(ReadNumber, GivesTheNearestDouble) {
  const std::pair<const char*, double> spellings[] = {
      {"1", 1.0},
      {"-1", -1.0},
      {".5", 0.5},
      {"5.", 5.0},
      {"0", 0.0},
      {"-0", -0.0},
      {"007.50", 7.5},
      {"5334760.6", 5334760.6},
      {"1e3", 1000.0},
      {"1e+3", 1000.0},
      {"1.e-2", 0.01},
      {".5e1", 5.0},
      {"0e99999999999999999999", 0.0},
      {"1e-99999999999999999999", 0.0},
      // the largest float, and a number just below the tie above it
      {"3.4028234663852886e38", std::numeric_limits<float>::max()},
      {"-3.402823567797336e38", -3.402823567797336e38},
      // the smallest normal and subnormal doubles, and a number below the tie between the latter and zero
      {"2.2250738585072014e-308", std::numeric_limits<double>::min()},
      {"2.4703282292062328e-324", std::numeric_limits<double>::denorm_min()},
      {"2.4703282292062327e-324", 0.0},
      // ties between two doubles
      {"9007199254740993", 9007199254740992.0},
      {"9007199254740995", 9007199254740996.0}};
  for (const auto& [word, wanted] : spellings) {
    double value = NAN;
    EXPECT_EQ(read_number(word, value), NumberFault::none) << word;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(value), std::bit_cast<std::uint64_t>(wanted))
        << word << " gives " << value;
  }
}

TEST(ReadNumber, RoundsOnceNextToTies) {
  // The middle between 1 + 2^-52 and 1 + 2^-51 goes up to even, the middle between 1 and 1 + 2^-52 down.
  const std::string up = "1.0000000000000003330669073875469621270895004272460937",
                    down = "1.0000000000000001110223024625156540423631668090820312";
  const std::string zeros(60, '0');
  const std::pair<std::string, double> spellings[] = {{down + "5", 0x1p0},
                                                      {down + "5" + zeros + "1", 0x1.0000000000001p0},
                                                      {down + "4" + std::string(60, '9'), 0x1p0},
                                                      {up + "5", 0x1.0000000000002p0},
                                                      {up + "5" + zeros + "1", 0x1.0000000000002p0},
                                                      {up + "4" + std::string(60, '9'), 0x1.0000000000001p0}};
  for (const auto& [word, wanted] : spellings) {
    double value = 0.0;
    EXPECT_EQ(read_number(word, value), NumberFault::none) << word;
    EXPECT_EQ(value, wanted) << word;
    EXPECT_EQ(read_number("-" + word, value), NumberFault::none) << word;
    EXPECT_EQ(value, -wanted) << word;
  }
}

TEST(ReadNumber, RefusesEverythingElse) {
  const std::pair<const char*, NumberFault> spellings[] = {
      {"", NumberFault::not_a_number},
      {".", NumberFault::not_a_number},
      {"+", NumberFault::not_a_number},
      {"+-1", NumberFault::not_a_number},
      {"1.2.3", NumberFault::not_a_number},
      {"1,5", NumberFault::not_a_number},
      {"1e", NumberFault::not_a_number},
      {"1e+", NumberFault::not_a_number},
      {"e5", NumberFault::not_a_number},
      {".e5", NumberFault::not_a_number},
      {"0x10", NumberFault::not_a_number},
      {"1#", NumberFault::not_a_number},
      {"nano", NumberFault::not_a_number},
      {"nan", NumberFault::not_finite},
      {"-NaN", NumberFault::not_finite},
      {"+INF", NumberFault::not_finite},
      {"-Infinity", NumberFault::not_finite},
      {"1e39", NumberFault::too_large},
      {"-1e39", NumberFault::too_large},
      {"3.4028235677973367e38", NumberFault::too_large},
      {"1e99999999999999999999", NumberFault::too_large}};
  for (const auto& [word, wanted] : spellings) {
    double value = 0.0;
    EXPECT_EQ(read_number(word, value), wanted) << word;
  }
}

/// The library's conversion, which the core cannot use.
double from_chars(std::string_view word) {
  double value = 0.0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  EXPECT_EQ(end, word.data() + word.size()) << word;
  EXPECT_EQ(fault, std::errc()) << word;
  return value;
}

TEST(ReadNumber, EqualsTheLibraryForRandomWords) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 200'000; ++trial) {
    // Random digits with a point, and an exponent that keeps the value in range.
    const int digits = 1 + static_cast<int>(random() % 25), point = static_cast<int>(random() % 26);
    std::string word = random() % 2 == 0 ? "-" : "";
    word += static_cast<char>('1' + random() % 9);
    for (int i = 1; i < digits; ++i) {
      if (i == point) word += '.';
      word += static_cast<char>('0' + random() % 10);
    }
    const int before = point > 0 && point < digits ? point : digits;
    if (random() % 2 == 0) word += "e" + std::to_string(static_cast<int>(random() % 74) - 36 - before);
    double value = 0.0;
    ASSERT_EQ(read_number(word, value), NumberFault::none) << word;
    ASSERT_EQ(value, from_chars(word)) << word;
  }
}

TEST(ReadNumber, ReadsBackEveryDoubleAndTheTiesNextToIt) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 100'000; ++trial) {
    // Up to the range of float; the first trials are below it.
    const std::uint64_t exponent = random() % (trial < 1000 ? 900 : 1150);
    const auto wanted = std::bit_cast<double>(random() >> 12 | exponent << 52);
    char text[1500];
    const auto shortest = std::to_chars(std::begin(text), std::end(text), wanted);
    double value = 0.0;
    ASSERT_EQ(read_number({text, shortest.ptr}, value), NumberFault::none);
    ASSERT_EQ(value, wanted);
    // All digits of the middle between this double and the next.
    const auto middle = 0.5L * (static_cast<long double>(wanted) + std::nextafter(wanted, 1e300));
    const auto exact =
        std::to_chars(std::begin(text), std::end(text), middle, std::chars_format::fixed, 1100);
    ASSERT_EQ(exact.ec, std::errc());
    ASSERT_EQ(read_number({text, exact.ptr}, value), NumberFault::none);
    ASSERT_EQ(value, static_cast<double>(middle)) << std::string_view(text, exact.ptr);
  }
}

TEST(ReadNumber, MessagesQuoteTheWordShortAndPrintable) {
  EXPECT_EQ(fault_text(NumberFault::not_a_number, "a\x1b[2J"), "'a?[2J' is not a number");
  EXPECT_EQ(fault_text(NumberFault::not_finite, "nan"), "'nan' is not finite");
  EXPECT_EQ(fault_text(NumberFault::too_large, std::string(50, '9')),
            "'" + std::string(40, '9') + "...' is too large");
}

}  // namespace
}  // namespace halfway

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

TEST(ReadNumber, GivesTheNearestFloat) {
  const std::pair<const char*, float> spellings[] = {
      {"1", 1.0f},
      {"-1", -1.0f},
      {".5", 0.5f},
      {"5.", 5.0f},
      {"0", 0.0f},
      {"-0", -0.0f},
      {"007.50", 7.5f},
      {"1e3", 1000.0f},
      {"1e+3", 1000.0f},
      {"1.e-2", 0.01f},
      {".5e1", 5.0f},
      {"0e99999999999999999999", 0.0f},
      {"1e-99999999999999999999", 0.0f},
      // the largest float, and a number just below the tie above it
      {"3.4028234663852886e38", std::numeric_limits<float>::max()},
      {"3.4028235677973365e38", std::numeric_limits<float>::max()},
      // the smallest normal and subnormal floats, and the tie between the latter and zero
      {"1.17549435082228751e-38", std::numeric_limits<float>::min()},
      {"1.40129846432481707e-45", std::numeric_limits<float>::denorm_min()},
      {"7."
       "00649232162408535461864791644958065640130970938257885878534141944895541342930"
       "300743319094181060791015625e-46",
       0.0f},
      {"7."
       "00649232162408535461864791644958065640130970938257885878534141944895541342930"
       "300743319094181060791015626e-46",
       std::numeric_limits<float>::denorm_min()},
      // ties between two floats
      {"16777217", 16777216.0f},
      {"16777219", 16777220.0f}};
  for (const auto& [word, wanted] : spellings) {
    float value = NAN;
    EXPECT_EQ(read_number(word, value), NumberFault::none) << word;
    EXPECT_EQ(std::bit_cast<std::uint32_t>(value), std::bit_cast<std::uint32_t>(wanted))
        << word << " gives " << value;
  }
}

TEST(ReadNumber, RoundsOnceNextToTies) {
  // The middle between 1 + 2^-23 and 1 + 2^-22 goes up to even, the middle between 1 and 1 + 2^-23 down.
  const std::string up = "1.00000017881393432617187", down = "1.00000005960464477539062";
  const std::string zeros(60, '0');
  const std::pair<std::string, float> spellings[] = {
      {down + "5", 0x1p0f},
      {down + "5" + zeros + "1", 0x1.000002p0f},
      {down + "4" + std::string(60, '9'), 0x1p0f},
      {up + "5", 0x1.000004p0f},
      {up + "5" + zeros + "1", 0x1.000004p0f},
      {up + "4" + std::string(60, '9'), 0x1.000002p0f},
      // The nearest double of each is the middle between two floats, and the float next to it whose last bit
      // is 0 is not the nearest. The first four are below the middle, the others above it.
      {"2857231255620718e-17", 0x1.d420f6p-6f},
      {"1740885909384815e-20", 0x1.24127ap-16f},
      {"2279717623377271e4", 0x1.3c5fd6p64f},
      {"2573286979527152e16", 0x1.44cb62p104f},
      {"2351119089871645e-17", 0x1.813516p-6f},
      {"2077587942039827e-20", 0x1.5c8fbap-16f},
      {"3148025925185464e4", 0x1.b4e05ap64f},
      {"3279784921006089e16", 0x1.9df792p104f}};
  for (const auto& [word, wanted] : spellings) {
    float value = 0.0f;
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
    float value = 0.0f;
    EXPECT_EQ(read_number(word, value), wanted) << word;
  }
}

/// The library's conversion, which the core cannot use.
float from_chars(std::string_view word) {
  float value = 0.0f;
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
    float value = 0.0f;
    ASSERT_EQ(read_number(word, value), NumberFault::none) << word;
    ASSERT_EQ(value, from_chars(word)) << word;
  }
}

TEST(ReadNumber, ReadsBackEveryFloatAndTheTiesNextToIt) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 100'000; ++trial) {
    const auto wanted = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (!std::isfinite(wanted)) continue;
    char text[400];
    const auto shortest = std::to_chars(std::begin(text), std::end(text), wanted);
    float value = 0.0f;
    ASSERT_EQ(read_number({text, shortest.ptr}, value), NumberFault::none);
    ASSERT_EQ(value, wanted);
    // All digits of the middle between this float and the next, which double represents exactly.
    const float next = std::nextafter(wanted, std::numeric_limits<float>::infinity());
    if (!std::isfinite(next)) continue;
    const double middle = 0.5 * (static_cast<double>(wanted) + static_cast<double>(next));
    const auto exact = std::to_chars(std::begin(text), std::end(text), middle, std::chars_format::fixed, 160);
    ASSERT_EQ(exact.ec, std::errc());
    ASSERT_EQ(read_number({text, exact.ptr}, value), NumberFault::none);
    ASSERT_EQ(value, static_cast<float>(middle)) << std::string_view(text, exact.ptr);
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

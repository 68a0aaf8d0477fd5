// SPDX-License-Identifier: Apache-2.0
// Every entry is the one nearest to MPFR's cosine. Every error bound holds and is reached. The compiled C++
// contains the same numbers; tb.cosine_rom compares them with those of the VHDL package.
#include "words/generator/cosine.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "common/test/big_real.hpp"
#include "words/cosine_tables.hpp"

namespace halfway::tables {
namespace {

constexpr int c_exact_powers[] = {1, 2, 4, 8, 16};
constexpr int c_published_powers[] = {1, 2};

std::string name_of(bool exact, int power, const CosineSize& size) {
  return fmt::format("{} cos^{}, {}", exact ? "exact" : "published", power, to_string(size));
}

std::string name_of(const CosineTable& table) {
  return name_of(table.exact, table.power, table.size);
}

// The angle at the middle of an entry's cell is pi * `odd` / 2^`shift`.
struct Angle {
  int odd, shift;
};

Angle middle_of(const CosineTable& table, int entry) {
  // (k + 1/2) / 2^K of pi/2.
  if (table.exact) return {2 * entry + 1, table.size.address_bits + 2};
  // (a' + 1/2) / 2^(K-1) of pi/2 (power 2) or of pi (power 1), a' the address as a signed number.
  const int half = 1 << (table.size.address_bits - 1);
  const int address = entry < half ? entry : entry - 2 * half;
  return {2 * address + 1, table.power == 2 ? table.size.address_bits + 1 : table.size.address_bits};
}

// Distance of an entry from its exact value, and of the exact value from a tie, in units of an entry's last
// bit.
struct Distance {
  double from_true, from_tie;
};

Distance distance(const CosineTable& table, int entry) {
  const Angle angle = middle_of(table, entry);
  BigReal cosine = cos(BigReal::pi() * angle.odd / std::ldexp(1.0, angle.shift));
  if (table.power == 1 && cosine < 0.0) cosine = 0.0;
  const BigReal value = pow(cosine, table.power) * table.size.largest_entry();
  return {std::fabs(static_cast<double>(value - table.entries[static_cast<std::size_t>(entry)])),
          std::fabs(static_cast<double>(fraction(value) - 0.5))};
}

void expect_correctly_rounded(const CosineTable& table) {
  ASSERT_EQ(table.entries.size(), static_cast<std::size_t>(table.size.entries())) << name_of(table);
  for (int entry = 0; entry < static_cast<int>(table.entries.size()); ++entry) {
    const Distance off = distance(table, entry);
    ASSERT_LT(off.from_true, 0.5) << name_of(table) << ", entry " << entry << " is " << table.entries[entry];
    ASSERT_GT(off.from_tie, 1e-9) << name_of(table) << ", entry " << entry;
  }
}

TEST(Cosine, EveryEntryOfEverySizeIsTheNearestToMpfr) {
  for (int address = 3; address <= 12; ++address)
    for (int data = 2; data <= 12; ++data) {
      const CosineSize size{address, data};
      EXPECT_EQ(parse_cosine_size(to_string(size)), size);
      for (const int power : c_exact_powers) expect_correctly_rounded(cosine_table(true, power, size));
      for (const int power : c_published_powers) expect_correctly_rounded(cosine_table(false, power, size));
    }
}

TEST(Cosine, ThereAreNoOtherSizesAndPowers) {
  EXPECT_THROW(cosine_table(true, 2, {2, 8}), std::invalid_argument);
  EXPECT_THROW(cosine_table(true, 2, {13, 8}), std::invalid_argument);
  EXPECT_THROW(cosine_table(true, 2, {9, 1}), std::invalid_argument);
  EXPECT_THROW(cosine_table(true, 2, {9, 13}), std::invalid_argument);
  EXPECT_THROW(cosine_table(true, 3, {9, 8}), std::invalid_argument);
  EXPECT_THROW(cosine_table(true, 32, {9, 8}), std::invalid_argument);
  EXPECT_THROW(cosine_table(false, 4, {6, 6}), std::invalid_argument);
}

TEST(Cosine, EachGeneratedTableExistsOnce) {
  std::vector<std::string> names;
  for (const CosineTable& table : cosine_tables()) names.push_back(name_of(table));
  EXPECT_THAT(names,
              ::testing::ElementsAre("exact cos^1, 9x8", "exact cos^2, 9x8", "exact cos^4, 9x8",
                                     "exact cos^8, 9x8", "exact cos^16, 9x8", "published cos^1, 6x6",
                                     "published cos^2, 6x6", "published cos^1, 4x4", "published cos^2, 4x4"));
  CosineSizes sizes;
  sizes.published.front() = {4, 4};
  EXPECT_EQ(cosine_tables(sizes).size(), 7U);
}

// The build makes the C++ tables of these sizes.
TEST(Cosine, ThePackageTellsItsSizes) {
  const CosineSizes other{{{12, 8}}, {{5, 6}, {4, 4}}};
  for (const CosineSizes& sizes : {CosineSizes{}, other}) {
    const CosineSizes found = cosine_sizes_in(cosine_vhdl_package(sizes));
    EXPECT_EQ(found.exact, sizes.exact);
    EXPECT_EQ(found.published, sizes.published);
  }
}

TEST(Cosine, TheCompiledTablesAreTheGeneratedOnes) {
  const std::vector<CosineTable> tables = cosine_tables();
  ASSERT_EQ(words::c_cosine_tables.size(), tables.size());
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const words::CosineTable& compiled = words::c_cosine_tables[i];
    EXPECT_EQ(name_of(compiled.exact, compiled.power, compiled.size), name_of(tables[i]));
    EXPECT_THAT(compiled.entries, ::testing::ElementsAreArray(tables[i].entries));
  }
  EXPECT_EQ(words::c_exact_cosine_size, (CosineSize{9, 8}));
  EXPECT_EQ(words::c_published_cosine_size, (CosineSize{6, 6}));
}

// ---- own tables

// cos^n at this part of an own table's reach.
long double own_truth(double exponent, double at) {
  return std::pow(std::cos(static_cast<long double>(at) * own_reach(exponent)),
                  static_cast<long double>(exponent));
}

TEST(OwnTable, EndsWhereTheHighlightEnds) {
  for (const double n : {1.0, 1.5, 2.0, 2.65, 20.0, 1000.0, 1e6})
    EXPECT_NEAR(std::pow(std::cos(own_reach(n)), n), c_own_end, 1e-9) << "n = " << n;
}

TEST(OwnTable, EntriesAreTheNearestToTheHighlight) {
  for (const double n : {1.0, 1.305, 2.65, 20.0, 1000.0})
    for (const CosineSize size : {CosineSize{5, 4}, {9, 8}, {11, 11}, {12, 12}}) {
      const CosineTable table = own_table(n, 4, size);
      const double largest = size.largest_entry();
      double found = 0.0;
      for (std::size_t i = 0; i < table.entries.size(); ++i) {
        const double middle = (static_cast<double>(i) + 0.5) / size.entries();
        EXPECT_NEAR(table.entries[i], static_cast<double>(largest * own_truth(n, middle)), 0.5 + 1e-6)
            << "n = " << n;
        for (const double part : {0.0, 0.5, 1.0}) {
          const double at = (static_cast<double>(i) + part) / size.entries();
          found = std::max(found, std::abs(table.entries[i] / largest - double(own_truth(n, at))));
        }
      }
      EXPECT_NEAR(table_error(table), found, 1e-9) << "n = " << n;
      EXPECT_LE(table_error(table), error_bound(table)) << "n = " << n;
    }
}

TEST(OwnTable, TakesThePlaceOfAPower) {
  CosineSizes sizes;
  sizes.exact = {c_own_size};
  sizes.own = {2.65, 20.0};
  std::vector<std::string> names;
  for (const CosineTable& table : cosine_tables(sizes))
    if (table.exact) names.push_back(fmt::format("{} {}", table.power, table.own));
  EXPECT_THAT(names, ::testing::ElementsAre("1 0", "2 2.65", "4 20"));
  sizes.own = {1, 2, 3, 4, 5};
  EXPECT_THROW(cosine_tables(sizes), std::invalid_argument);
  EXPECT_THROW(own_table(0.99, 2, {9, 8}), std::invalid_argument);
}

}  // namespace
}  // namespace halfway::tables

// SPDX-License-Identifier: Apache-2.0
// Every entry is the one nearest to MPFR's cosine. Every error bound holds and is reached. The committed VHDL
// and C++ contain the same numbers.
#include "words/generator/cosine.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "common/test/big_real.hpp"
#include "words/cosine_tables.hpp"

namespace halfway::tables {
namespace {

constexpr int c_exact_powers[] = {1, 2, 4, 8, 16};
constexpr int c_published_powers[] = {1, 2};

std::string name_of(bool exact, int power, const CosineSize& size) {
  return fmt::format("{} cos^{}, {}/{} bits", exact ? "exact" : "published", power, size.address_bits,
                     size.data_bits);
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
  for (int address_bits = 3; address_bits <= 12; ++address_bits)
    for (int data_bits = 2; data_bits <= 12; ++data_bits) {
      for (const int power : c_exact_powers)
        expect_correctly_rounded(cosine_table(true, power, {address_bits, data_bits}));
      for (const int power : c_published_powers)
        expect_correctly_rounded(cosine_table(false, power, {address_bits, data_bits}));
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

TEST(Cosine, ThePublishedTableIsAWholePeriod) {
  using ::testing::ElementsAre;
  EXPECT_THAT(cosine_table(false, 2, {4, 4}).entries,
              ElementsAre(15, 14, 12, 9, 6, 3, 1, 0, 0, 1, 3, 6, 9, 12, 14, 15));
  EXPECT_THAT(cosine_table(false, 1, {4, 4}).entries,
              ElementsAre(15, 12, 8, 3, 0, 0, 0, 0, 0, 0, 0, 0, 3, 8, 12, 15));
}

// An independent definition of the table's function at `position` cells from angle 0.
double truth(const CosineTable& table, double position) {
  const double cells = std::ldexp(1.0, table.size.address_bits);
  if (table.exact) return std::pow(std::cos(std::numbers::pi / 2 * position / cells), table.power);
  if (table.power == 2) return std::pow(std::cos(std::numbers::pi * position / cells), 2);
  return std::max(0.0, std::cos(2 * std::numbers::pi * position / cells));
}

double sampled_error(const CosineTable& table) {
  const int cells = static_cast<int>(table.entries.size());
  double largest = 0;
  for (int entry = 0; entry < cells; ++entry)
    for (const double part : {0.0, 1e-6, 0.1, 0.25, 0.5, 0.75, 0.9, 1 - 1e-6}) {
      const int low = table.exact || entry < cells / 2 ? entry : entry - cells;
      const double value = table.entries[entry] / double(table.size.largest_entry());
      largest = std::max(largest, std::fabs(value - truth(table, low + part)));
    }
  return largest;
}

void expect_error_is_reached(const CosineTable& table) {
  const double bound = table_error(table), sampled = sampled_error(table);
  EXPECT_GE(bound, sampled - 1e-14) << name_of(table);
  // The first and last samples are 1e-6 of a cell from its ends. A turn has eight or more cells.
  EXPECT_LE(bound, sampled + 1e-6 * table.power) << name_of(table);
}

TEST(Cosine, TheErrorIsTheLargestOverAllAngles) {
  for (const auto& [address_bits, data_bits] :
       {std::pair{3, 2}, {3, 12}, {4, 4}, {5, 6}, {6, 6}, {9, 8}, {12, 2}, {12, 12}}) {
    for (const int power : c_exact_powers)
      expect_error_is_reached(cosine_table(true, power, {address_bits, data_bits}));
    for (const int power : c_published_powers)
      expect_error_is_reached(cosine_table(false, power, {address_bits, data_bits}));
  }
}

TEST(Cosine, AWrongEntryRaisesTheError) {
  for (const bool exact : {true, false}) {
    CosineTable table = cosine_table(exact, 2, {6, 6});
    for (std::size_t i = 0; i < table.entries.size(); ++i) {
      CosineTable wrong = table;
      wrong.entries[i] ^= 32;
      EXPECT_GT(table_error(wrong), 32.0 / 63 - 0.03) << name_of(table) << ", entry " << i;
      expect_error_is_reached(wrong);
    }
  }
}

TEST(Cosine, EachGeneratedTableExistsOnce) {
  std::vector<std::string> names;
  for (const CosineTable& table : cosine_tables()) names.push_back(name_of(table));
  EXPECT_THAT(
      names, ::testing::ElementsAre("exact cos^1, 9/8 bits", "exact cos^2, 9/8 bits", "exact cos^4, 9/8 bits",
                                    "exact cos^8, 9/8 bits", "exact cos^16, 9/8 bits",
                                    "published cos^1, 6/6 bits", "published cos^2, 6/6 bits",
                                    "published cos^1, 4/4 bits", "published cos^2, 4/4 bits"));
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

using Constants = std::map<std::string, std::vector<std::uint32_t>>;

// The tables in a text by name: the numbers between the start and the end of an aggregate.
Constants constants(const std::string& text, const std::string& open, const std::string& close) {
  Constants found;
  for (std::size_t at = 0; (at = text.find(open, at)) != std::string::npos;) {
    at += open.size();
    const std::size_t name = text.rfind("c_", at), end = text.find(close, at);
    std::vector<std::uint32_t>& numbers = found[text.substr(name, text.find(' ', name) - name)];
    while ((at = text.find_first_of("0123456789", at)) < end) {
      std::size_t length = 0;
      numbers.push_back(static_cast<std::uint32_t>(std::stoul(text.substr(at, 8), &length)));
      at += length;
    }
    at = end;
  }
  return found;
}

void expect_texts_carry(const CosineSizes& sizes) {
  const std::string vhdl = cosine_vhdl_package(sizes), cpp = cosine_cpp_header(sizes);
  const Constants in_vhdl = constants(vhdl, ") := (\n", ");"), in_cpp = constants(cpp, " = {\n", "\n}");
  const std::vector<CosineTable> tables = cosine_tables(sizes);
  EXPECT_EQ(in_vhdl.size(), tables.size());
  EXPECT_EQ(in_vhdl, in_cpp);
  for (const CosineTable& t : tables) {
    const std::string name = fmt::format("c_{}_cosine_{}_{}_{}", t.exact ? "exact" : "published", t.power,
                                         t.size.address_bits, t.size.data_bits);
    ASSERT_TRUE(in_vhdl.contains(name)) << name;
    EXPECT_EQ(in_vhdl.at(name), t.entries) << name;
    EXPECT_THAT(vhdl,
                ::testing::HasSubstr(fmt::format(
                    "if {} and power = {} and address_bits = {} and data_bits = {} then\n      return {};",
                    t.exact ? "exact" : "not exact", t.power, t.size.address_bits, t.size.data_bits, name)));
    EXPECT_THAT(cpp, ::testing::HasSubstr(fmt::format("{{{}, {}, {{{}, {}}}, {}}}", t.exact, t.power,
                                                      t.size.address_bits, t.size.data_bits, name)));
  }
  for (const std::string& text : {vhdl, cpp})
    for (std::size_t start = 0, end; (end = text.find('\n', start)) != std::string::npos; start = end + 1)
      EXPECT_LE(end - start, 120U) << text.substr(start, end - start);
}

TEST(Cosine, VhdlAndCppCarryTheSameNumbers) {
  expect_texts_carry({});
  expect_texts_carry({{{12, 12}}, {{4, 4}, {4, 4}}});
  expect_texts_carry({{{3, 2}}, {{5, 6}, {4, 4}}});
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
    for (const auto& [address_bits, data_bits] : {std::pair{5, 4}, {9, 8}, {11, 11}, {12, 12}}) {
      const CosineTable table = own_table(n, 4, {address_bits, data_bits});
      const double largest = std::ldexp(1.0, data_bits) - 1;
      double found = 0.0;
      for (std::size_t i = 0; i < table.entries.size(); ++i) {
        const double middle = std::ldexp(static_cast<double>(i) + 0.5, -address_bits);
        EXPECT_NEAR(table.entries[i], static_cast<double>(largest * own_truth(n, middle)), 0.5 + 1e-6)
            << "n = " << n;
        for (const double part : {0.0, 0.5, 1.0}) {
          const double at = std::ldexp(static_cast<double>(i) + part, -address_bits);
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
  expect_texts_carry(sizes);
  sizes.own = {1, 2, 3, 4, 5};
  EXPECT_THROW(cosine_tables(sizes), std::invalid_argument);
  EXPECT_THROW(own_table(0.99, 2, {9, 8}), std::invalid_argument);
}

}  // namespace
}  // namespace halfway::tables

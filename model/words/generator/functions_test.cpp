// SPDX-License-Identifier: Apache-2.0
// Every value is the one nearest to MPFR's. The sizes are those of the formats. The compiled C++ contains the
// same numbers.
#include "words/generator/functions.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "common/test/big_real.hpp"
#include "golden/function_rom.hpp"
#include "sim/os/file.hpp"
#include "words/formats.hpp"
#include "words/function_tables.hpp"

namespace halfway::tables {
namespace {

std::string name_of(const FunctionTable& table) {
  return fmt::format("{} {}", table.exact ? "exact" : "published", to_string(table.function));
}

// The function's argument for value `index`, in units of 2^-(cell_bits + 1): exact.
long argument(const FunctionTable& table, long index) {
  const long half_cells = 2 * index + (table.slope_bits > 0 ? 0 : 1), one = 2L << table.cell_bits;
  switch (table.function) {
    case Function::reciprocal_root:
      // The first half of the cells ends at 2. The other cells are twice as wide.
      return 2 * half_cells < one ? one + 2 * half_cells : 4 * half_cells;
    case Function::logarithm:
      return one + half_cells;
    case Function::decay:
      break;
  }
  return half_cells;
}

BigReal function_of(Function function, const BigReal& x) {
  switch (function) {
    case Function::reciprocal_root:
      return 1.0 / sqrt(x);
    case Function::logarithm:
      return log2(x);
    case Function::decay:
      break;
  }
  return exp2(0.0 - x);
}

// Distance of a value from the exact one, in units of its last bit, and of the exact value from a tie.
std::pair<double, double> distance(const FunctionTable& table, long index) {
  const BigReal x =
      BigReal(static_cast<double>(argument(table, index))) / std::ldexp(1.0, table.cell_bits + 1);
  const BigReal value = function_of(table.function, x) * std::ldexp(1.0, table.fraction_bits);
  return {std::fabs(static_cast<double>(value - table.values[static_cast<std::size_t>(index)])),
          std::fabs(static_cast<double>(fraction(value) - 0.5))};
}

TEST(Functions, EveryValueIsTheNearestToMpfr) {
  for (const FunctionTable& table : function_tables()) {
    ASSERT_EQ(table.values.size(), (std::size_t{1} << table.cell_bits) + (table.slope_bits > 0 ? 1U : 0U))
        << name_of(table);
    for (std::size_t i = 0; i < table.values.size(); ++i) {
      const auto [from_true, from_tie] = distance(table, static_cast<long>(i));
      ASSERT_LT(from_true, 0.5) << name_of(table) << ", value " << i << " is " << table.values[i];
      ASSERT_GT(from_tie, 1e-9) << name_of(table) << ", value " << i;
    }
  }
}

TEST(Functions, ValuesAndSlopesFitTheirBits) {
  for (const FunctionTable& table : function_tables()) {
    const std::size_t cells = std::size_t{1} << table.cell_bits;
    std::uint32_t steepest = 0, largest = 0;
    for (std::size_t i = 0; i < cells; ++i) {
      largest = std::max(largest, table.values[i]);
      if (table.slope_bits == 0) continue;
      const std::int64_t slope = std::int64_t{table.values[i + 1]} - table.values[i];
      EXPECT_EQ(slope > 0, table.function == Function::logarithm) << name_of(table) << ", value " << i;
      steepest = std::max(steepest, static_cast<std::uint32_t>(std::abs(slope)));
    }
    // The widths must not be larger than needed.
    EXPECT_EQ(std::bit_width(largest), table.value_bits) << name_of(table);
    EXPECT_EQ(std::bit_width(steepest), table.slope_bits) << name_of(table);
  }
}

template <class Preset>
void expect_formats() {
  const words::FunctionTable& root = golden::function_table<Preset>(words::Function::reciprocal_root);
  EXPECT_EQ(root.value_bits, Preset::c_root_entry_bits);
  EXPECT_EQ(root.fraction_bits, Preset::c_root_entry_fraction_bits);
}

TEST(Functions, TheRootsEntryHasItsFormat) {
  expect_formats<words::Exact>();
  expect_formats<words::Published>();
}

// The testbench of the tables runs from the first function to the last; its vectors list them by hand. A
// missing function would not be tested.
TEST(Functions, TheTestbenchReadsEveryFunction) {
  const std::filesystem::path source = HALFWAY_SOURCE_DIR;
  const auto testbenches = read_file(source / "tb/vectors/rows.toml");
  const auto vectors = read_file(source / "tb/vectors/shading.cpp");
  ASSERT_TRUE(testbenches && vectors);
  EXPECT_THAT(*testbenches, ::testing::HasSubstr(fmt::format("for = \"which in c_{} to c_{}\"",
                                                             to_string(c_functions.front()),
                                                             to_string(c_functions.back()))));
  for (const Function function : c_functions)
    EXPECT_THAT(*vectors, ::testing::HasSubstr(fmt::format("words::Function::{}", to_string(function))));
}

// tb.function_rom compares them with those of the VHDL package.
TEST(Functions, TheCompiledTablesAreTheGeneratedOnes) {
  for (const FunctionTable& table : function_tables()) {
    const words::FunctionTable& compiled =
        (table.exact ? words::c_exact_functions
                     : words::c_published_functions)[static_cast<std::size_t>(table.function)];
    EXPECT_THAT(compiled.values, ::testing::ElementsAreArray(table.values)) << name_of(table);
    EXPECT_EQ(compiled.cell_bits, table.cell_bits) << name_of(table);
    EXPECT_EQ(compiled.value_bits, table.value_bits) << name_of(table);
    EXPECT_EQ(compiled.fraction_bits, table.fraction_bits) << name_of(table);
    EXPECT_EQ(compiled.slope_bits, table.slope_bits) << name_of(table);
  }
}

}  // namespace
}  // namespace halfway::tables

// SPDX-License-Identifier: Apache-2.0
#include "words/generator/functions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string_view>

#include "common/to_integer.hpp"
#include "words/generator/formats.hpp"
#include "words/generator/wrapped_numbers.hpp"

namespace halfway::tables {
namespace {

// The function at `position` cells from the start of the first cell. Positions and arguments are exact.
long double value_of(const FunctionTable& table, long double position) {
  const long double cells = std::ldexp(1.0L, table.cell_bits);
  switch (table.function) {
    case Function::reciprocal_root:
      // The ranges 1 to 2 and 2 to 4 have the same number of cells.
      return 1.0L / std::sqrt(position < cells / 2 ? 1.0L + position / (cells / 2) : 4.0L * position / cells);
    case Function::logarithm:
      return std::log2(1.0L + position / cells);
    case Function::decay:
      return std::exp2(-position / cells);
  }
  return 0.0L;
}

std::uint32_t correctly_rounded(const FunctionTable& table, int index) {
  const long double offset = table.slope_bits > 0 ? 0.0L : 0.5L;
  const long double value = std::ldexp(value_of(table, index + offset), table.fraction_bits);
  const long double above_tie = value - std::floor(value) - 0.5L;
  // The computed functions have errors of a few epsilon, and their values are at most 1.
  const long double doubt = std::ldexp(8 * std::numeric_limits<long double>::epsilon(), table.fraction_bits);
  if (std::fabs(above_tie) <= doubt)
    throw std::logic_error(fmt::format("{}: value {} is too near a tie to be rounded in long double",
                                       to_string(table.function), index));
  const auto rounded = to_integer<std::uint32_t>(std::floor(value)) + (above_tie > 0 ? 1 : 0);
  // The value after the last cell is used only for a difference.
  if (index == 1 << table.cell_bits) return rounded;
  return std::min(rounded, (std::uint32_t{1} << table.value_bits) - 1);
}

FunctionTable made(FunctionTable table) {
  const int count = (1 << table.cell_bits) + (table.slope_bits > 0 ? 1 : 0);
  for (int i = 0; i < count; ++i) table.values.push_back(correctly_rounded(table, i));
  return table;
}

std::string function_constant_name(const FunctionTable& table) {
  return fmt::format("c_{}_{}", preset_name(table.exact), to_string(table.function));
}

constexpr std::string_view c_functions_notice =
    "Made by `make tables` from model/words/generator/functions.cpp; edit that.";

// Half the error of a Newton step for twice the root, from an entry of 1/sqrt(x): 3/2 of the squared relative
// error of the entry, in units of 2^-23. The error of the entry is sqrt(2) u / 2 (rounding) plus w / 2
// (cell).
int root_raise(const FunctionTable& table) {
  const double error =
      std::numbers::sqrt2 * std::ldexp(0.5, -table.fraction_bits) + std::ldexp(0.5, -table.cell_bits);
  return to_integer<int>(std::round(std::ldexp(1.5 * error * error, 23)));
}

}  // namespace

// u is the unit of a value, w the width of a cell. (For 1/sqrt up to 2 the width is 2w and the slope at most
// 1/2; from 2 on 4w and 2^-2.5.) Rounding adds an error of u/2. With the value at a cell's middle add half a
// cell times the slope. With interpolation along a chord add w^2/8 of the second derivative, and u for the
// truncation of the product.
std::vector<FunctionTable> function_tables(bool exact, const WordLengths& words) {
  // 1/sqrt(x) with `bits` bits, or with those of other word lengths.
  const auto root = [&](bool of_exact, int bits, double error) {
    const int made_bits = of_exact == exact ? words.seed_bits.value_or(bits) : bits;
    FunctionTable table = made({of_exact,
                                Function::reciprocal_root,
                                made_bits - c_seed_cells,
                                made_bits,
                                made_bits,
                                0,
                                off_by(error, "", "u / 2 + 2 * w / 2 * (1 / 2)"),
                                {}});
    if (made_bits != bits) table.error.value = derived(table);
    return table;
  };
  return {
      root(true, 12, 0.0011),
      made({true, Function::logarithm, 9, 24, 24, 16, off_by(7.8e-7, "", "u / 2 + w^2 / 8 / ln2 + u"), {}}),
      made({true, Function::decay, 6, 19, 18, 12, off_by(2.04e-5, "", "u / 2 + w^2 / 8 * ln2^2 + u"), {}}),
      root(false, 9, 0.0088),
      made({false, Function::logarithm, 6, 10, 10, 0, off_by(0.0118, "", "u / 2 + w / 2 / ln2"), {}}),
      made({false, Function::decay, 6, 8, 8, 0, off_by(0.0074, "", "u / 2 + w / 2 * ln2"), {}})};
}

double derived(const FunctionTable& table) {
  const Quantity quantities[] = {{"u", std::ldexp(1.0, -table.fraction_bits)},
                                 {"w", std::ldexp(1.0, -table.cell_bits)},
                                 {"ln2", std::numbers::ln2}};
  return evaluated(table.error.derivation, quantities);
}

std::string function_vhdl_package(const std::vector<FunctionTable>& tables) {
  std::string out = fmt::format(
      "-- SPDX-License-Identifier: Apache-2.0\n-- {}\n"
      "-- Functions over cells, correctly rounded. With slope bits a value is the function at the start of "
      "its "
      "cell, and\n"
      "-- one more value follows the last cell; without, it is the function at the middle of the cell.\n\n"
      "package function_pkg is\n\n",
      c_functions_notice);
  auto to = std::back_inserter(out);
  for (const Function function : c_functions)
    fmt::format_to(to, "  constant c_{} : natural := {};\n", to_string(function), static_cast<int>(function));
  out +=
      "\n  type function_format_t is record\n    cell_bits     : positive;\n    value_bits    : positive;\n"
      "    fraction_bits : positive;\n    slope_bits    : natural; -- of the difference of neighbours\n"
      "  end record;\n\n"
      "  type function_table_t is array (natural range <>) of natural;\n\n"
      "  function function_format (exact : boolean; which : natural) return function_format_t;\n\n"
      "  function function_table (exact : boolean; which : natural) return function_table_t;\n\n"
      "  -- Added to twice a root after a Newton step, in units of 2**-23: half of its largest shortfall.\n"
      "  function root_raise (exact : boolean) return natural;\n\n"
      "end package;\n\npackage body function_pkg is\n\n";
  for (const FunctionTable& table : tables)
    fmt::format_to(to, "  -- {}, w a cell\n  constant {} : function_table_t(0 to {}) := (\n{});\n\n",
                   to_string(table.error), function_constant_name(table), table.values.size() - 1,
                   wrapped_numbers(table.values, "    ", 118));
  const auto choose = [&](std::string_view name, std::string_view type, const auto& text_of) {
    fmt::format_to(to, "  function {} (exact : boolean; which : natural) return {} is\n  begin\n", name,
                   type);
    for (const FunctionTable& table : tables)
      fmt::format_to(to, "    if {}exact and which = c_{} then\n      return {};\n    end if;\n",
                     table.exact ? "" : "not ", to_string(table.function), text_of(table));
    fmt::format_to(to,
                   "    report \"{0}: there is no function \" & integer'image(which) severity failure;\n"
                   "    return {1};\n  end function;\n\n",
                   name, text_of(tables.front()));
  };
  choose("function_format", "function_format_t", [](const FunctionTable& table) {
    return fmt::format("({}, {}, {}, {})", table.cell_bits, table.value_bits, table.fraction_bits,
                       table.slope_bits);
  });
  choose("function_table", "function_table_t", function_constant_name);
  out += "  function root_raise (exact : boolean) return natural is\n  begin\n";
  for (const FunctionTable& table : tables)
    if (table.function == Function::reciprocal_root)
      fmt::format_to(to, "{}    return {};\n{}", table.exact ? "    if exact then\n  " : "",
                     root_raise(table), table.exact ? "    end if;\n" : "");
  out += "  end function;\n\n";
  out += "end package body;\n";
  return out;
}

std::string function_cpp_header(const std::vector<FunctionTable>& tables) {
  std::string out = fmt::format(
      "// SPDX-License-Identifier: Apache-2.0\n// {}\n"
      "// Functions over cells, correctly rounded. With slope bits a value is the function at the start of "
      "its "
      "cell, and\n"
      "// one more value follows the last cell; without, it is the function at the middle of the cell.\n"
      "#pragma once\n\n#include <array>\n#include <cstdint>\n#include <span>\n\n"
      "namespace halfway::words {{\n\n"
      "enum class Function {{ ",
      c_functions_notice);
  auto to = std::back_inserter(out);
  for (const Function function : c_functions)
    fmt::format_to(to, "{}{}", to_string(function), function == c_functions.back() ? " };\n\n" : ", ");
  out +=
      "struct FunctionTable {\n  int cell_bits, value_bits, fraction_bits;\n"
      "  int slope_bits;  // of the difference of neighbours\n"
      "  std::span<const std::uint32_t> values;\n};\n";
  for (const FunctionTable& table : tables)
    fmt::format_to(
        to, "\n// {}, w a cell\ninline constexpr std::array<std::uint32_t, {}> {}_values = {{\n{}\n}};\n",
        to_string(table.error), table.values.size(), function_constant_name(table),
        wrapped_numbers(table.values, "    ", 110));
  out +=
      "\n// Added to twice a root after a Newton step, in units of 2^-23: half of its largest shortfall.\n";
  for (const FunctionTable& table : tables)
    if (table.function == Function::reciprocal_root)
      fmt::format_to(to, "inline constexpr std::uint32_t c_{}_root_raise = {};\n", preset_name(table.exact),
                     root_raise(table));
  // By preset, then by function.
  for (const bool exact : {true, false}) {
    fmt::format_to(to, "\ninline constexpr std::array<FunctionTable, {}> c_{}_functions = {{{{\n",
                   c_functions.size(), preset_name(exact));
    for (const FunctionTable& table : tables)
      if (table.exact == exact)
        fmt::format_to(to, "    {{{}, {}, {}, {}, {}_values}},\n", table.cell_bits, table.value_bits,
                       table.fraction_bits, table.slope_bits, function_constant_name(table));
    out += "}};\n";
  }
  out += "\n}  // namespace halfway::words\n";
  return out;
}

}  // namespace halfway::tables

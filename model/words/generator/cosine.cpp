// SPDX-License-Identifier: Apache-2.0
#include "words/generator/cosine.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <ranges>
#include <span>
#include <stdexcept>
#include <string_view>

#include "common/cosine_power.hpp"
#include "common/to_integer.hpp"
#include "words/generator/formats.hpp"
#include "words/generator/wrapped_numbers.hpp"

namespace halfway::tables {
namespace {

constexpr int c_exact_powers[] = {1, 2, 4, 8, 16};
constexpr int c_published_powers[] = {1, 2};

std::span<const int> powers(bool exact) {
  if (exact) return c_exact_powers;
  return c_published_powers;
}

// The cell [low, low + 1] of an entry, counted from angle 0.
int low_of_cell(const CosineTable& table, int entry) {
  const int cells = table.size.entries();
  return table.exact || entry < cells / 2 ? entry : entry - cells;
}

// A quarter turn has 2^(address_bits - shift) cells.
int shift_of_cells(const CosineTable& table) {
  return table.exact ? 0 : table.power == 1 ? 2 : 1;
}

// cos^exponent x for x in [0, pi/2]. 1 - cos x is computed, because cos x rounds to 1 close to the peak.
// Error at most 32 epsilon: where the result is not below 2^-12, its logarithm is at most 9 and is off by 3
// epsilon of it.
long double highlight(double exponent, long double x) {
  const long double half_sine = std::sin(x / 2), versine = 2 * half_sine * half_sine;
  return versine < 1.0L ? std::exp(exponent * std::log1p(-versine)) : 0.0L;
}

// The table's function, `position` cells from angle 0. Error at most 8 * power * epsilon: 4 epsilon for the
// cosine, including the rounding of its angle; each squaring doubles the error and rounds once.
long double bell(const CosineTable& table, long double position) {
  // The number of cells per quarter turn is a power of two, so the quotient is exact.
  const long double cells = std::ldexp(1.0L, table.size.address_bits - shift_of_cells(table));
  const long double quarters = position / cells;
  if (table.own > 0.0) return highlight(table.own, std::fabs(quarters) * own_reach(table.own));
  if (std::fabs(quarters) >= 1.0L) return 0.0L;
  long double value = std::cos(std::numbers::pi_v<long double> / 2 * quarters);
  for (int power = table.power; power > 1; power /= 2) value *= value;
  return value;
}

double exponent_of(const CosineTable& table) {
  return table.own > 0.0 ? table.own : table.power;
}

long double largest_word(const CosineTable& table) {
  return std::ldexp(1.0L, table.size.data_bits) - 1.0L;
}

std::uint32_t correctly_rounded(const CosineTable& table, int entry) {
  const long double value = largest_word(table) * bell(table, low_of_cell(table, entry) + 0.5L);
  const long double above_tie = value - std::floor(value) - 0.5L;
  const long double doubt = largest_word(table) * (table.own > 0.0 ? 33 : 9 * table.power) *
                            std::numeric_limits<long double>::epsilon();
  if (std::fabs(above_tie) <= doubt)
    throw std::logic_error(fmt::format(
        "cosine table: entry {} of cos^{}, {} bits, is too near a tie to be rounded in long double", entry,
        exponent_of(table), to_string(table.size)));
  return to_integer<std::uint32_t>(std::floor(value)) + (above_tie > 0 ? 1 : 0);
}

std::string constant_name(const CosineTable& table) {
  return fmt::format("c_{}_cosine_{}_{}", preset_name(table.exact), table.power, to_string(table.size));
}

std::string bound_comment(const CosineTable& table, std::string_view mark) {
  return fmt::format("{} off by at most {:.3g}: half a step, and half a cell where cos^{} is steepest", mark,
                     error_bound(table), exponent_of(table));
}

constexpr std::string_view c_cosine_notice =
    "Made by `make tables` from model/words/generator/cosine.cpp; edit that.";

CosineTable made_table(CosineTable table) {
  if (std::ranges::find(powers(table.exact), table.power) == powers(table.exact).end() ||
      !parse_cosine_size(to_string(table.size)))
    throw std::invalid_argument(fmt::format("cosine table: there is no {} cos^{} of {} bits",
                                            preset_name(table.exact), exponent_of(table),
                                            to_string(table.size)));
  const int entries = table.size.entries();
  table.entries.reserve(entries);
  for (int entry = 0; entry < entries; ++entry) table.entries.push_back(correctly_rounded(table, entry));
  return table;
}

// Preset exact: the cosine, then the own tables instead of the other powers.
void add_own_tables(const CosineSizes& sizes, const CosineSize& size, std::vector<CosineTable>& tables) {
  if (sizes.own.size() > c_most_own_tables)
    throw std::invalid_argument(
        fmt::format("cosine table: {} own tables, not at most {}", sizes.own.size(), c_most_own_tables));
  tables.push_back(cosine_table(true, 1, size));
  for (std::size_t i = 0; i < sizes.own.size(); ++i)
    tables.push_back(own_table(sizes.own[i], c_exact_powers[i + 1], size));
}

}  // namespace

std::optional<CosineSize> parse_cosine_size(std::string_view text) {
  CosineSize size;
  for (size.address_bits = c_smallest_cosine_size.address_bits;
       size.address_bits <= c_largest_cosine_size.address_bits; ++size.address_bits)
    for (size.data_bits = c_smallest_cosine_size.data_bits; size.data_bits <= c_largest_cosine_size.data_bits;
         ++size.data_bits)
      if (text == to_string(size)) return size;
  return std::nullopt;
}

CosineTable cosine_table(bool exact, int power, const CosineSize& size) {
  return made_table({exact, power, size, {}});
}

CosineTable own_table(double exponent, int power, const CosineSize& size) {
  if (!(exponent >= 1.0)) throw std::invalid_argument(fmt::format("own table: exponent {} < 1", exponent));
  return made_table({true, power, size, {}, exponent});
}

std::vector<CosineTable> cosine_tables(const CosineSizes& sizes) {
  std::vector<CosineTable> tables;
  for (const bool exact : {true, false}) {
    std::vector<CosineSize> made;
    for (const CosineSize& size : exact ? sizes.exact : sizes.published) {
      if (std::ranges::find(made, size) != made.end()) continue;
      made.push_back(size);
      if (exact && !sizes.own.empty()) {
        add_own_tables(sizes, size, tables);
        continue;
      }
      for (const int power : powers(exact)) tables.push_back(cosine_table(exact, power, size));
    }
  }
  return tables;
}

double table_error(const CosineTable& table) {
  // Peak and zero lie at the ends of cells. The function is therefore monotonic over a cell, and its greatest
  // distance from the entry is at one end of the cell. Beyond the zero, table and function are zero.
  long double largest = 0;
  for (int entry = 0; entry < static_cast<int>(table.entries.size()); ++entry) {
    const long double value = table.entries[entry] / largest_word(table);
    const int low = low_of_cell(table, entry);
    for (const int end : {low, low + 1}) largest = std::max(largest, std::fabs(value - bell(table, end)));
  }
  return static_cast<double>(largest);
}

double error_bound(const CosineTable& table) {
  const double half_bell = table.own > 0.0 ? own_reach(table.own) : std::numbers::pi / 2;
  const double cell = half_bell * std::ldexp(1.0, shift_of_cells(table) - table.size.address_bits);
  return 0.5 / static_cast<double>(largest_word(table)) + steepest_slope(exponent_of(table)) * cell / 2;
}

std::string cosine_vhdl_package(const CosineSizes& sizes) {
  const std::vector<CosineTable> tables = cosine_tables(sizes);
  std::map<std::string, CosineSize> all;
  for (const CosineTable& table : tables) all[vhdl_name(table.size)] = table.size;
  std::string out = fmt::format(
      "-- SPDX-License-Identifier: Apache-2.0\n-- {}\n"
      "-- Powers of the cosine, correctly rounded, times 2^data_bits - 1. Preset exact: over half a bell, "
      "from its\n"
      "-- peak; preset published: over a full period, the address signed, and zero where the cosine is "
      "negative.\n\n"
      "package cosine_pkg is\n\n"
      "  type cosine_table_t is array (natural range <>) of natural;\n\n"
      "  -- The sizes of the tables: address bits x data bits.\n"
      "  type cosine_t is ({});\n\n"
      "  function default_cosine (exact : boolean) return cosine_t;\n\n"
      "  function address_bits (size : cosine_t) return positive;\n\n"
      "  function data_bits (size : cosine_t) return positive;\n\n"
      "  function cosine_table (exact : boolean; power : positive; size : cosine_t) return "
      "cosine_table_t;\n\n"
      "end package;\n\npackage body cosine_pkg is\n\n",
      c_cosine_notice, fmt::join(std::views::keys(all), ", "));
  auto to = std::back_inserter(out);
  for (const CosineTable& table : tables)  // 120 columns including the closing bracket
    fmt::format_to(to, "  {}\n  constant {} : cosine_table_t(0 to {}) := (\n{});\n\n",
                   bound_comment(table, "--"), constant_name(table), table.entries.size() - 1,
                   wrapped_numbers(table.entries, "    ", 118));
  fmt::format_to(
      to,
      "  function default_cosine (exact : boolean) return cosine_t is\n  begin\n    if exact then\n"
      "      return {};\n    end if;\n    return {};\n  end function;\n\n",
      vhdl_name(sizes.exact.front()), vhdl_name(sizes.published.front()));
  const auto choose = [&](std::string_view name, int CosineSize::* bits) {
    fmt::format_to(to, "  function {} (size : cosine_t) return positive is\n  begin\n    case size is\n",
                   name);
    for (const auto& [literal, size] : all)
      fmt::format_to(to, "      when {} =>\n        return {};\n", literal, size.*bits);
    out += "    end case;\n  end function;\n\n";
  };
  choose("address_bits", &CosineSize::address_bits);
  choose("data_bits", &CosineSize::data_bits);
  out +=
      "  function cosine_table (exact : boolean; power : positive; size : cosine_t) return cosine_table_t "
      "is\n"
      "  begin\n";
  for (const CosineTable& table : tables)
    fmt::format_to(to, "    if {}exact and power = {} and size = {} then\n      return {};\n    end if;\n",
                   table.exact ? "" : "not ", table.power, vhdl_name(table.size), constant_name(table));
  out +=
      "    report \"cosine_table: there is no table for exact \" & boolean'image(exact) & \", power \" & "
      "integer'image(power) &\n"
      "      \", size \" & cosine_t'image(size)\n"
      "      severity failure;\n"
      "    return (0 to 2 ** address_bits(size) - 1 => 0);\n"
      "  end function;\n\n"
      "end package body;\n";
  return out;
}

CosineSizes cosine_sizes_in(const std::string& vhdl_package) {
  CosineSizes sizes{{}, {}};
  for (const bool exact : {true, false}) {
    const std::string mark = fmt::format("constant c_{}_cosine_1_", preset_name(exact));
    for (std::size_t at = 0; (at = vhdl_package.find(mark, at)) != std::string::npos;) {
      at += mark.size();
      if (const auto size =
              parse_cosine_size(std::string_view(vhdl_package).substr(at, vhdl_package.find(' ', at) - at)))
        (exact ? sizes.exact : sizes.published).push_back(*size);
    }
  }
  return sizes;
}

std::string cosine_cpp_header(const CosineSizes& sizes) {
  const std::vector<CosineTable> tables = cosine_tables(sizes);
  std::string out = fmt::format(
      "// SPDX-License-Identifier: Apache-2.0\n// {}\n"
      "// Powers of the cosine, correctly rounded, times 2^data_bits - 1. Preset exact: over half a bell, "
      "from its\n"
      "// peak; preset published: over a full period, the address signed, and zero where the cosine is "
      "negative.\n"
      "#pragma once\n\n#include <array>\n#include <cstdint>\n#include <span>\n\n"
      "#include \"words/generator/cosine_size.hpp\"\n\n"
      "namespace halfway::words {{\n\n"
      "struct CosineTable {{\n  bool exact;\n  int power;\n  CosineSize size;\n"
      "  std::span<const std::uint16_t> entries;\n}};\n\n"
      "// The default size.\n",
      c_cosine_notice);
  auto to = std::back_inserter(out);
  for (const bool exact : {true, false}) {
    const CosineSize& size = (exact ? sizes.exact : sizes.published).front();
    fmt::format_to(to, "inline constexpr CosineSize c_{}_cosine_size{{{}, {}}};\n", preset_name(exact),
                   size.address_bits, size.data_bits);
  }
  for (const CosineTable& table : tables)
    fmt::format_to(to, "\n{}\ninline constexpr std::array<std::uint16_t, {}> {} = {{\n{}\n}};\n",
                   bound_comment(table, "//"), table.entries.size(), constant_name(table),
                   wrapped_numbers(table.entries, "    ", 110));
  fmt::format_to(to, "\ninline constexpr std::array<CosineTable, {}> c_cosine_tables = {{{{\n",
                 tables.size());
  for (const CosineTable& table : tables)
    fmt::format_to(to, "    {{{}, {}, {{{}, {}}}, {}}},\n", table.exact, table.power, table.size.address_bits,
                   table.size.data_bits, constant_name(table));
  out += "}};\n\n}  // namespace halfway::words\n";
  return out;
}

}  // namespace halfway::tables

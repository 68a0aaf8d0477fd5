// SPDX-License-Identifier: Apache-2.0
// The tables over whole cells instead of at samples. A function that is monotonic over a cell has its
// greatest distance from a constant at an end of the cell. The distance of a chord from a concave or convex
// function has one maximum inside the cell; the tangents at both ends bound it.
#include <fmt/format.h>

#include <cstdlib>

#include "interval.hpp"
#include "registry.hpp"
#include "tables/cosine.hpp"
#include "tables/functions.hpp"

namespace halfway::bounds {
namespace {

using tables::CosineTable, tables::Function, tables::FunctionTable;

// A table value must be the nearest one to its function at its argument, and not only within the table's
// bound.
void expect_nearest(double value, double unit, Enclosure truth, int index, TableFinding& finding) {
  if (farthest(value, truth) > unit / 2 * (1 + 0x1p-40))
    finding.failure = fmt::format("value {} is not the nearest", index);
}

// The table's function at number / 2^shift of a quarter turn, or of an own table's reach.
Enclosure cosine_at(const CosineTable& table, int number, int shift) {
  if (table.own > 0.0) return highlight({number, shift}, tables::own_reach(table.own), table.own);
  if (number >= 1 << shift) return {0, 0};
  return cosine_power({number, shift}, table.power);
}

// |entry - cos^power| over the cell of each entry.
TableFinding cosine_finding(const CosineTable& table) {
  TableFinding finding;
  finding.table =
      fmt::format("{}{} cos^{} {}/{}", table.exact ? "exact" : "published", table.own > 0.0 ? " own" : "",
                  table.own > 0.0 ? table.own : table.power, table.address_bits, table.data_bits);
  finding.bound = finding.derived = tables::error_bound(table);
  const int cells = 1 << table.address_bits, full = (1 << table.data_bits) - 1;
  const int shift = table.address_bits - (table.exact ? 0 : table.power == 1 ? 2 : 1);
  const int quarter = 1 << shift;  // cells
  for (int entry = 0; entry < cells; ++entry) {
    const int low = table.exact || entry < cells / 2 ? entry : entry - cells;
    const double value = static_cast<double>(table.entries[static_cast<std::size_t>(entry)]) / full;
    const int middle = std::abs(2 * low + 1);
    expect_nearest(value, 1.0 / full, cosine_at(table, middle, shift + 1), entry, finding);
    for (const int end : {low, low + 1}) {
      const Enclosure truth = cosine_at(table, std::abs(end), shift);
      // The rounding of the quotient is added.
      const double error = farthest(value, truth) + 0x1p-52;
      keep_worst(finding, error, [&] {
        return fmt::format("entry {} at {}/{} of {}", entry, end, quarter,
                           table.own > 0.0 ? "the table's reach" : "a quarter turn");
      });
    }
  }
  return finding;
}

// The argument `index` cells after the start of the first cell.
Dyadic argument(const FunctionTable& table, int index) {
  const int cells = 1 << table.address_bits;
  if (table.function == Function::logarithm) return {cells + index, table.address_bits};
  if (table.function == Function::decay) return {index, table.address_bits};
  return index < cells / 2 ? Dyadic{cells + 2 * index, table.address_bits}
                           : Dyadic{4 * index, table.address_bits};
}
Enclosure value_at(const FunctionTable& table, Dyadic x) {
  if (table.function == Function::logarithm) return logarithm(x);
  if (table.function == Function::decay) return decay(x);
  return reciprocal_root(x);
}

// The value is that of the cell's centre.
TableFinding step_finding(const FunctionTable& table, TableFinding finding) {
  for (int i = 0; i < 1 << table.address_bits; ++i) {
    const double value = std::ldexp(table.values[static_cast<std::size_t>(i)], -table.fraction_bits);
    const Dyadic from = argument(table, i), to = argument(table, i + 1);
    expect_nearest(value, std::ldexp(1.0, -table.fraction_bits),
                   value_at(table, {from.number + to.number, from.shift + 1}), i, finding);
    for (const int end : {i, i + 1}) {
      const Dyadic x = argument(table, end);
      const double error = farthest(value, value_at(table, x));
      keep_worst(finding, error,
                 [&] { return fmt::format("value {} at x = {}", i, std::ldexp(x.number, -x.shift)); });
    }
  }
  return finding;
}

// The values are those of the cell's ends. The chord between them is cut to the unit below, towards the first
// value. All three are monotonic on each of many parts of a cell.
TableFinding chord_finding(const FunctionTable& table, TableFinding finding) {
  constexpr int c_part_bits = 6, c_parts = 1 << c_part_bits;
  const double unit = std::ldexp(1.0, -table.fraction_bits);
  const bool rises = table.function == Function::logarithm;
  for (int i = 0; i < 1 << table.address_bits; ++i) {
    const double first = table.values[static_cast<std::size_t>(i)] * unit,
                 last = table.values[static_cast<std::size_t>(i) + 1] * unit;
    const Dyadic x = argument(table, i);
    const auto at = [&](int part) {
      return value_at(table, {(x.number << c_part_bits) + part, x.shift + c_part_bits});
    };
    const auto chord = [&](int part) { return first + (last - first) * part / c_parts; };
    Enclosure from = at(0);
    expect_nearest(first, unit, from, i, finding);
    expect_nearest(last, unit, at(c_parts), i + 1, finding);
    for (int part = 0; part < c_parts; ++part) {
      const Enclosure to = at(part + 1);
      // At the ends of a part the distance is computed in doubles. Between them it differs by the bend of the
      // part.
      const double bend = std::ldexp(1.0, -2 * (table.address_bits + c_part_bits) - 3) * 1.4427;
      double high = -1, low = 1;  // chord - truth
      for (const auto& [p, truth] : {std::pair{part, from}, std::pair{part + 1, to}}) {
        high = std::max(high, chord(p) - truth.low);
        low = std::min(low, chord(p) - truth.high);
      }
      const double error =
          std::max(high + bend + (rises ? 0 : unit), -low + bend + (rises ? unit : 0)) + 0x1p-52;
      from = to;
      keep_worst(finding, error, [&] { return fmt::format("cell {}, part {} of {}", i, part, c_parts); });
    }
  }
  return finding;
}

constexpr const char* c_functions[] = {"1/sqrt(x)", "log2(x)", "2^-x"};

}  // namespace

std::vector<TableFinding> cosine_tables(const Context& context) {
  std::vector<TableFinding> findings;
  for (const CosineTable& table : tables::cosine_tables()) findings.push_back(cosine_finding(table));
  // Own tables, of exponents from the smallest to the largest.
  for (const double exponent : {1.0, 1.305, 2.65, 20.0, 1000.0, 1e6})
    findings.push_back(cosine_finding(
        tables::own_table(exponent, 2, tables::c_own_size.address_bits, tables::c_own_size.data_bits)));
  // All other sizes that `make tables` accepts.
  TableFinding others{.table = "the other sizes, 3/2 to 12/12"};
  double nearest = 0, farthest_away = 1;
  int count = 0;
  const int step = context.quick ? 3 : 1;
  for (int address = 3; address <= 12; address += step)
    for (int data = 2; data <= 12; data += step)
      for (const auto& [exact, power] :
           {std::pair{true, 1}, {true, 2}, {true, 4}, {true, 8}, {true, 16}, {false, 1}, {false, 2}}) {
        const TableFinding finding = cosine_finding(tables::cosine_table(exact, power, address, data));
        ++count;
        if (!finding.failure.empty()) others.failure = finding.table + ": " + finding.failure;
        const double ratio = finding.worst / finding.bound;
        farthest_away = std::min(farthest_away, ratio);
        if (ratio <= nearest) continue;
        nearest = ratio;
        others.bound = others.derived = finding.bound;
        others.worst = finding.worst;
        others.where = finding.table + ", " + finding.where;
      }
  others.table = fmt::format("{} sizes and powers, 3/2 to 12/12 bits", count);
  others.where += fmt::format("; the smallest share of the bound is {:.2f}", farthest_away);
  findings.push_back(others);
  return findings;
}

std::vector<TableFinding> function_tables() {
  std::vector<TableFinding> findings;
  for (const FunctionTable& table : tables::function_tables()) {
    TableFinding finding;
    finding.table = fmt::format("{} {}", table.exact ? "exact" : "published",
                                c_functions[static_cast<int>(table.function)]);
    finding.bound = table.error.value;
    finding.derived = tables::derived(table);
    findings.push_back(table.slope_bits > 0 ? chord_finding(table, finding) : step_finding(table, finding));
  }
  return findings;
}

}  // namespace halfway::bounds

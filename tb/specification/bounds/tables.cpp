// SPDX-License-Identifier: Apache-2.0
// The tables over whole cells instead of at samples. A function that is monotonic over a cell has its
// greatest distance from a constant at an end of the cell. The distance of a chord from a concave or convex
// function has one maximum inside the cell; the tangents at both ends bound it.
#include <fmt/format.h>

#include <cstdlib>

#include "common/test/big_real.hpp"
#include "registry.hpp"
#include "words/generator/cosine.hpp"
#include "words/generator/functions.hpp"

namespace halfway::bounds {
namespace {

using tables::CosineTable, tables::Function, tables::FunctionTable;

// The table's function at a part of a quarter turn, or of an own table's reach.
BigReal cosine_at(const CosineTable& table, double part) {
  if (table.own > 0.0) return pow(cos(BigReal(part) * tables::own_reach(table.own)), table.own);
  return part < 1.0 ? pow(cos(BigReal::pi() * (part / 2)), table.power) : 0.0;
}

// |entry - cos^power| over the cell of each entry.
TableFinding cosine_finding(const CosineTable& table) {
  TableFinding finding;
  finding.table =
      fmt::format("{}{} cos^{} {}", table.exact ? "exact" : "published", table.own > 0.0 ? " own" : "",
                  table.own > 0.0 ? table.own : table.power, to_string(table.size));
  finding.bound = finding.derived = tables::error_bound(table);
  const int cells = table.size.entries(), full = table.size.largest_entry();
  const int quarter = cells >> (table.exact ? 0 : table.power == 1 ? 2 : 1);  // cells
  for (int entry = 0; entry < cells; ++entry) {
    const int low = table.exact || entry < cells / 2 ? entry : entry - cells;
    const double value = static_cast<double>(table.entries[static_cast<std::size_t>(entry)]) / full;
    for (const int end : {low, low + 1}) {
      // The rounding of the quotient is added.
      const double error = distance(value, cosine_at(table, std::abs(end) / double(quarter))) + 0x1p-52;
      keep_worst(finding, error, [&] {
        return fmt::format("entry {} at {}/{} of {}", entry, end, quarter,
                           table.own > 0.0 ? "the table's reach" : "a quarter turn");
      });
    }
  }
  return finding;
}

// The argument `index` cells after the start of the first cell.
double argument(const FunctionTable& table, double index) {
  const int cells = 1 << table.cell_bits;
  if (table.function == Function::logarithm) return 1 + index / cells;
  if (table.function == Function::decay) return index / cells;
  return index < cells / 2 ? 1 + 2 * index / cells : 4 * index / cells;
}
BigReal value_at(const FunctionTable& table, double index) {
  const double x = argument(table, index);
  if (table.function == Function::logarithm) return log2(x);
  return table.function == Function::decay ? exp2(-x) : 1.0 / sqrt(x);
}

// The value is that of the cell's centre.
TableFinding step_finding(const FunctionTable& table, TableFinding finding) {
  for (int i = 0; i < 1 << table.cell_bits; ++i) {
    const double value = std::ldexp(table.values[static_cast<std::size_t>(i)], -table.fraction_bits);
    for (const int end : {i, i + 1})
      keep_worst(finding, distance(value, value_at(table, end)),
                 [&] { return fmt::format("value {} at x = {}", i, argument(table, end)); });
  }
  return finding;
}

// The values are those of the cell's ends. The chord between them is cut to the unit below, towards the first
// value. All three are monotonic on each of many parts of a cell.
TableFinding chord_finding(const FunctionTable& table, TableFinding finding) {
  constexpr int c_parts = 64;
  const double unit = std::ldexp(1.0, -table.fraction_bits);
  const bool rises = table.function == Function::logarithm;
  for (int i = 0; i < 1 << table.cell_bits; ++i) {
    const double first = table.values[static_cast<std::size_t>(i)] * unit,
                 last = table.values[static_cast<std::size_t>(i) + 1] * unit;
    const auto chord_minus_truth = [&](int part) {
      const double along = double(part) / c_parts;
      return static_cast<double>(first + (last - first) * along - value_at(table, i + along));
    };
    // At the ends of a part the distance is known. Between them it differs by the bend of the part.
    const double bend = std::ldexp(1.0, -2 * table.cell_bits - 3) / (c_parts * c_parts) * 1.4427;
    double from = chord_minus_truth(0);
    for (int part = 0; part < c_parts; ++part) {
      const double to = chord_minus_truth(part + 1), high = std::max(from, to), low = std::min(from, to);
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
    findings.push_back(cosine_finding(tables::own_table(exponent, 2, tables::c_own_size)));
  // All other sizes that `make tables` accepts.
  TableFinding others{.table = "the other sizes, 3x2 to 12x12"};
  double nearest = 0, farthest_away = 1;
  int count = 0;
  const int step = context.quick ? 3 : 1;
  for (int address = 3; address <= 12; address += step)
    for (int data = 2; data <= 12; data += step)
      for (const auto& [exact, power] :
           {std::pair{true, 1}, {true, 2}, {true, 4}, {true, 8}, {true, 16}, {false, 1}, {false, 2}}) {
        const TableFinding finding = cosine_finding(tables::cosine_table(exact, power, {address, data}));
        ++count;
        const double ratio = finding.worst / finding.bound;
        farthest_away = std::min(farthest_away, ratio);
        if (ratio <= nearest) continue;
        nearest = ratio;
        others.bound = others.derived = finding.bound;
        others.worst = finding.worst;
        others.where = finding.table + ", " + finding.where;
      }
  others.table = fmt::format("{} sizes and powers, 3x2 to 12x12", count);
  others.where += fmt::format("; the smallest share of the bound is {:.2f}", farthest_away);
  findings.push_back(others);
  return findings;
}

std::vector<TableFinding> function_tables(const Context& /*context*/) {
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

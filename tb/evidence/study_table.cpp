// SPDX-License-Identifier: Apache-2.0
#include "evidence/study_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/files/template.hpp"

namespace halfway::page {
namespace {

constexpr const char* c_judged = "largest_error";
// Columns of a study and their headings.
constexpr std::pair<const char*, const char*> c_columns[] = {
    {"scene", "scene"},
    {"point", "design"},
    {"psnr_db", "PSNR, dB"},
    {"rms", "rms error"},
    {c_judged, "largest error"},
    {"host_evaluations", "points or vectors evaluated by the host"},
    {"init_vectors", "init vectors"},
    {"line_records", "line records"},
    {"cycles", "cycles"},
    {"cells", "cells"},
    {"device_luts", "device's LUTs"},
    {"device_rams", "device's RAMs"},
    {"clock_mhz", "clock, MHz"},
    {"frame_ns", "ns per frame"}};

// Integers as they are, other numbers with four digits or as integers.
std::string shown(const Table& table, std::size_t row, const char* column) {
  const std::string& text = table.text(row, column);
  const auto number = table.number(row, column);
  if (text.empty()) return "–";
  constexpr double c_four_digits = 1000;
  if (!number || text.find_first_of(".e") == std::string::npos) return text;
  return *number < c_four_digits ? fmt::format("{:.4g}", *number) : fmt::format("{:.0f}", *number);
}

}  // namespace

std::string study_table(std::span<const Table> tables) {
  std::vector<std::string> headings;
  std::size_t count = 0;
  for (const Table& table : tables) count += table.rows.size();
  std::vector<std::vector<std::string>> rows(count);
  for (const auto& [column, heading] : c_columns) {
    std::vector<std::string> cells;
    for (const Table& table : tables)
      for (std::size_t row = 0; row < table.rows.size(); ++row) cells.push_back(shown(table, row, column));
    if (column != c_judged && std::ranges::count(cells, cells.front()) == std::ssize(cells)) continue;
    headings.emplace_back(heading);
    for (std::size_t row = 0; row < count; ++row) rows[row].push_back(cells[row]);
  }
  return markdown_table(headings, rows);
}

}  // namespace halfway::page

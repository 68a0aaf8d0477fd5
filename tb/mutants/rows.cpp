// SPDX-License-Identifier: Apache-2.0
#include "mutants/rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <sstream>

#include "sim/files/template.hpp"
#include "sim/os/file.hpp"

namespace halfway::mutants {
namespace {

constexpr std::size_t c_shown = 3;  // survivors of a VHDL line that the page names

using Cells = std::vector<std::string>;

Cells words_of(const std::string& line, char separator) {
  Cells words;
  std::istringstream stream(line);
  for (std::string word; std::getline(stream, word, separator);) words.push_back(word);
  return words;
}

// A row of numbers, summed over rows.
using Sum = std::array<unsigned long, 4>;  // faults, found, equivalent, survived

void add(Sum& sum, const Cells& cells, std::size_t first) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += std::stoul(cells.at(first + i));
}
Cells row_of(const std::string& name, const Sum& sum) {
  Cells cells{name};
  for (const unsigned long count : sum) cells.push_back(std::to_string(count));
  return cells;
}

}  // namespace

Reasons::Reasons(const std::filesystem::path& source)
    : source_(source), listed_(read_survivors(source / "tb/mutants/survivors.toml")) {}

std::string Reasons::line_at(const std::string& place) const {
  const auto colon = place.find(':');
  if (colon == std::string::npos) return {};
  const std::string file = place.substr(0, colon);
  const auto text = read_file(source_ / "rtl" / file);
  if (!text) return {};
  std::istringstream lines(*text);
  std::string line;
  for (int number = std::stoi(place.substr(colon + 1)); number > 0 && std::getline(lines, line); --number)
    continue;
  line = line.substr(0, line.find("--"));
  const std::size_t begin = line.find_first_not_of(' '), end = line.find_last_not_of(' ');
  return begin == std::string::npos ? file : fmt::format("{}: {}", file, line.substr(begin, end + 1 - begin));
}

std::string Reasons::of(std::string_view line, std::string_view netlist) const {
  const std::string known = line.empty() ? fmt::format("not known: {}", netlist) : std::string(line);
  for (const Survivor& survivor : listed_)
    if (known.starts_with(survivor.file + ":") && known.find(survivor.text) != std::string::npos)
      return survivor.reason;
  return {};
}

std::vector<page::Section> mutant_sections(std::span<const page::Row> rows, const Reasons& reasons) {
  constexpr std::size_t c_first_count = 2;  // of a row's fields
  std::vector<Cells> netlists, testbenches, kind_rows, survivor_rows;
  Cells columns, testbench_columns;
  Sum all{};
  std::map<std::string, Sum> kinds;
  std::map<std::pair<std::string, std::string>, Cells> survivors;
  for (const page::Row& row : rows) {
    const bool is_netlist = row.section == c_netlist_section;
    Cells names, cells;
    for (const auto& [key, value] : row.fields) {
      names.push_back(key);
      cells.push_back(value);
    }
    (is_netlist ? netlists : testbenches).push_back(cells);
    (is_netlist ? columns : testbench_columns) = names;
    if (!is_netlist) continue;
    add(all, cells, c_first_count);
    for (const std::string& line : words_of(row.details, '\n')) {
      const Cells words = words_of(line, '\t');
      if (words.at(0) == c_kind)
        add(kinds[words.at(1)], words, 2);
      else
        survivors[{words.at(1), row.name}].push_back(words.at(2));
    }
  }
  if (netlists.empty()) return {};
  Cells sum = row_of("**all**", all);
  sum.insert(sum.begin() + 1, "");
  sum.resize(columns.size());
  netlists.push_back(sum);
  for (const auto& [kind, counts] : kinds) kind_rows.push_back(row_of(kind, counts));
  for (const auto& [at, texts] : survivors) {
    std::string shown = fmt::format(
        "{}", fmt::join(texts.begin(),
                        texts.begin() + static_cast<std::ptrdiff_t>(std::min(texts.size(), c_shown)), "; "));
    if (texts.size() > c_shown) shown += fmt::format("; {} more", texts.size() - c_shown);
    const std::string reason = reasons.of(at.first, at.second);
    survivor_rows.push_back({at.first.empty() ? "not known" : "`" + at.first + "`", "`" + at.second + "`",
                             std::to_string(texts.size()), "`" + shown + "`",
                             reason.empty() ? "not decided" : reason});
  }
  const unsigned long possible = all[0] - all[2];
  const Cells kind_columns{"kind", "faults", "found", "equivalent", "survived"};
  const Cells survivor_columns{"VHDL line", "netlist", "faults", "number, kind, port, wire", "reason"};
  std::vector<page::Section> sections{
      {std::string(c_netlist_section),
       fmt::format("Of the {} faults that are not proved equivalent, the vectors find {:.1f} %.\n\n{}\n{}",
                   possible,
                   100.0 * static_cast<double>(all[1]) / static_cast<double>(std::max(possible, 1UL)),
                   markdown_table(columns, netlists), markdown_table(kind_columns, kind_rows))}};
  if (!testbenches.empty())
    sections.push_back({std::string(c_source_section), markdown_table(testbench_columns, testbenches)});
  sections.push_back({"Survivors", markdown_table(survivor_columns, survivor_rows)});
  return sections;
}

std::vector<page::Value> mutant_values(std::span<const page::Row> rows) {
  constexpr double c_percent = 100;
  std::vector<page::Value> values;
  double possible = 0, found = 0;
  for (const page::Row& row : rows) {
    if (row.section != c_netlist_section) continue;
    const double possible_of_row = std::stod(row.field("faults")) - std::stod(row.field("equivalent"));
    const double found_of_row = std::stod(row.field("found"));
    values.push_back({"mutants",
                      row.name,
                      {possible_of_row > 0 ? c_percent * found_of_row / possible_of_row : c_percent}});
    possible += possible_of_row;
    found += found_of_row;
  }
  if (possible > 0) values.push_back({"mutants", "all netlists", {c_percent * found / possible}});
  return values;
}

}  // namespace halfway::mutants

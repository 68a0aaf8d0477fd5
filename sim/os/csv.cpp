// SPDX-License-Identifier: Apache-2.0
#include "sim/os/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "sim/os/file.hpp"

namespace halfway {
namespace {

// The values of one line; std::nullopt where a quote is not closed.
std::optional<std::vector<std::string>> values_of(std::string_view line) {
  std::vector<std::string> values(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quoted && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"')
      values.back() += line[++i];
    else if (line[i] == '"')
      quoted = !quoted;
    else if (line[i] == ',' && !quoted)
      values.emplace_back();
    else
      values.back() += line[i];
  }
  if (quoted) return std::nullopt;
  return values;
}

std::string line_of(const std::vector<std::string>& values) {
  std::string line;
  const char* before = "";
  for (std::string value : values) {
    if (value.find_first_of(",\"") != std::string::npos) {
      for (std::size_t at = 0; (at = value.find('"', at)) != std::string::npos; at += 2)
        value.insert(at, 1, '"');
      value = '"' + value + '"';
    }
    line += before + value;
    before = ",";
  }
  return line + "\n";
}

}  // namespace

const std::string& Table::text(std::size_t row, const std::string& column) const {
  static const std::string c_none;
  const auto it = std::ranges::find(columns, column);
  return it == columns.end() ? c_none : rows[row][static_cast<std::size_t>(it - columns.begin())];
}

std::optional<double> Table::number(std::size_t row, const std::string& column) const {
  const std::string& value = text(row, column);
  double number = 0.0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (error != std::errc() || end != value.data() + value.size() || !std::isfinite(number))
    return std::nullopt;
  return number;
}

Result<Table> read_csv(const std::filesystem::path& path) {
  auto reader = LineReader::open(path);
  if (!reader) return reader.error();
  Table table;
  for (std::string_view line;;) {
    const auto more = reader->next(line);
    if (!more) return more.error();
    if (!*more) break;
    if (line.ends_with('\r')) line.remove_suffix(1);
    auto values = values_of(line);
    if (!values) return reader->at("a value's second quote is missing; make the table again");
    if (table.columns.empty())
      table.columns = std::move(*values);
    else if (values->size() != table.columns.size())
      return reader->at(fmt::format("has {} values, the first line names {} columns; make the table again",
                                    values->size(), table.columns.size()));
    else
      table.rows.push_back(std::move(*values));
  }
  if (table.columns.empty()) return bad_input(path.string() + ":1: names no columns; make the table again");
  return table;
}

std::string to_csv(const Table& table) {
  std::string text = line_of(table.columns);
  for (const std::vector<std::string>& row : table.rows) text += line_of(row);
  return text;
}

}  // namespace halfway

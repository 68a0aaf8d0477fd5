// SPDX-License-Identifier: Apache-2.0
#include "evidence/evidence.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "sim/pages/template.hpp"
#include "sim/system/file.hpp"
#include "sim/system/folder_lock.hpp"

namespace halfway::evidence {
namespace {

constexpr std::size_t c_longest_line = 1U << 20;  // whole tables
constexpr std::string_view c_equals = " = ";
constexpr std::string_view c_section = "section", c_hash = "hash", c_details = "details";

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (c == '\n')
      result += "\\n";
    else if (c == '\\')
      result += "\\\\";
    else
      result += c;
  return result;
}

std::string unescaped(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool is_escape = text[at] == '\\' && at + 1 < text.size();
    if (is_escape) ++at;
    result += is_escape && text[at] == 'n' ? '\n' : text[at];
  }
  return result;
}

const Row* find(std::span<const Row> rows, std::string_view name) {
  const auto row = std::ranges::find(rows, name, &Row::name);
  return row == rows.end() ? nullptr : &*row;
}

std::string value_of(const Row& row, std::string_view column) {
  const auto field = std::ranges::find(row.fields, column, &Fields::value_type::first);
  return field == row.fields.end() ? std::string() : field->second;
}

// The described fields replace those of the same name.
void describe(Row& row, const Today& today) {
  row.section = today.section;
  for (const auto& [key, value] : today.fields) {
    const auto field = std::ranges::find(row.fields, key, &Fields::value_type::first);
    if (field != row.fields.end()) field->second = value;
  }
}

}  // namespace

Result<std::vector<Row>> read_rows(const std::filesystem::path& file) {
  std::vector<Row> rows;
  if (!std::filesystem::exists(file)) return rows;
  auto reader = LineReader::open(file, c_longest_line);
  if (!reader) return reader.error();
  std::string_view line;
  for (auto next = reader->next(line); next != LineReader::Next::end_of_file; next = reader->next(line)) {
    if (next == LineReader::Next::failed) return reader->error();
    if (line.empty() || line.front() == '#') continue;
    if (line.front() == '[' && line.back() == ']') {
      rows.push_back({.name = std::string(line.substr(1, line.size() - 2)), .line = reader->line_number()});
      if (find(std::span(rows).first(rows.size() - 1), rows.back().name) != nullptr)
        return reader->at("a second row of this name");
      continue;
    }
    const std::size_t equals = line.find(c_equals);
    if (rows.empty() || equals == std::string_view::npos)
      return reader->at("not a row: [name] or key = value");
    const std::string_view key = line.substr(0, equals);
    std::string value = unescaped(line.substr(equals + c_equals.size()));
    Row& row = rows.back();
    if (key == c_section)
      row.section = std::move(value);
    else if (key == c_hash)
      row.hash = std::move(value);
    else if (key == c_details)
      row.details = std::move(value);
    else
      row.fields.emplace_back(key, std::move(value));
  }
  return rows;
}

std::string text_of(std::span<const Row> rows) {
  std::string text =
      "# Measured rows of a page, each with the hash of what it depends on. Written by `make evidence`.\n";
  for (const Row& row : rows) {
    text += fmt::format("\n[{}]\n{} = {}\n{} = {}\n", row.name, c_section, escaped(row.section), c_hash,
                        row.hash);
    if (!row.details.empty()) text += fmt::format("{} = {}\n", c_details, escaped(row.details));
    for (const auto& [key, value] : row.fields) text += fmt::format("{} = {}\n", key, escaped(value));
  }
  return text;
}

std::vector<page::Section> sections_of(std::span<const Row> rows) {
  std::vector<page::Section> sections;
  for (const Row& first : rows) {
    if (std::ranges::find(sections, first.section, &page::Section::heading) != sections.end()) continue;
    std::vector<std::string> columns;
    for (const auto& [key, value] : first.fields) columns.push_back(key);
    const bool is_whole = columns == std::vector<std::string>{std::string(page::c_table)};
    std::vector<std::vector<std::string>> cells;
    std::string text;
    for (const Row& row : rows) {
      if (row.section != first.section) continue;
      cells.emplace_back();
      for (const std::string& column : columns) cells.back().push_back(value_of(row, column));
      if (is_whole) text += cells.back().front();
    }
    sections.push_back({first.section, is_whole ? text : markdown_table(columns, cells)});
  }
  return sections;
}

Result<Evidence> Evidence::open(Place place, std::vector<Today> today) {
  auto rows = read_rows(place.root / place.rows);
  if (!rows) return rows.error();
  for (const Today& row : today)
    if (find(today, row.name) != &row)
      return bad_input(fmt::format("{}: two rows of this name: {}", place.rows, row.name));
  return Evidence(std::move(place), std::move(today), std::move(*rows));
}

const std::string& Evidence::hash_of(std::string_view name) const {
  static const std::string c_none;
  const Today* row = find(today_, name);
  return row == nullptr ? c_none : row->hash;
}

bool Evidence::is_stale(std::string_view name) const {
  const Row* row = find(rows_, name);
  const Today* today = find(today_, name);
  return row == nullptr || today == nullptr || row->hash != today->hash;
}

std::vector<std::string> Evidence::faults() const {
  std::vector<std::string> faults;
  for (const Today& today : today_) {
    const Row* row = find(rows_, today.name);
    if (row == nullptr) {
      faults.push_back(
          fmt::format("{}: {}: was never measured; make evidence measures it", place_.rows, today.name));
      continue;
    }
    Row described = *row;
    describe(described, today);
    if (row->hash != today.hash)
      faults.push_back(
          fmt::format("{}:{}: {}: what it depends on has changed; make evidence measures it again",
                      place_.rows, row->line, row->name));
    else if (described.section != row->section || described.fields != row->fields)
      faults.push_back(fmt::format("{}:{}: {}: its description has changed; make evidence rewrites it",
                                   place_.rows, row->line, row->name));
  }
  for (const Row& row : rows_)
    if (find(today_, row.name) == nullptr)
      faults.push_back(fmt::format("{}:{}: {}: does not exist any more; make evidence removes it",
                                   place_.rows, row.line, row.name));
  const auto page = read_file(place_.root / place_.page);
  if (!page)
    faults.push_back(page.error().message);
  else if (page::with_sections(*page, place_.sections(rows_)) != *page)
    faults.push_back(
        fmt::format("{}: is not written from {}; make evidence writes it", place_.page, place_.rows));
  return faults;
}

template <class Change>
Status Evidence::change(const Change& change) const {
  const std::filesystem::path file = place_.root / place_.rows;
  const auto lock = FolderLock::take(file.parent_path(), [] {});
  if (!lock) return lock.error();
  auto rows = read_rows(file);
  if (!rows) return rows.error();
  change(*rows);
  // Keep the order of the page. Rows that today has not come last.
  const auto position = [&](const Row& row) {
    return std::ranges::find(today_, row.name, &Row::name) - today_.begin();
  };
  std::ranges::stable_sort(*rows, {}, position);
  if (Status written = write_file(file, text_of(*rows)); !written) return written;
  return page::write_sections(place_.root / place_.page, place_.sections(*rows));
}

Status Evidence::put(Row row) const {
  return change([&](std::vector<Row>& rows) {
    const auto old = std::ranges::find(rows, row.name, &Row::name);
    if (old == rows.end())
      rows.push_back(row);
    else
      *old = row;
  });
}

Status Evidence::remove(std::string_view name) const {
  return change(
      [&](std::vector<Row>& rows) { std::erase_if(rows, [&](const Row& row) { return row.name == name; }); });
}

Status Evidence::finish() const {
  return change([&](std::vector<Row>& rows) {
    std::erase_if(rows, [&](const Row& row) { return find(today_, row.name) == nullptr; });
    for (Row& row : rows) describe(row, *find(today_, row.name));
  });
}

const std::map<std::string, Mode>& modes() {
  static const std::map<std::string, Mode> c_modes = {
      {"all", Mode::all}, {"stale", Mode::stale}, {"check", Mode::check}};
  return c_modes;
}

CLI::Option* add_option(CLI::App& app, Mode& mode) {
  return app
      .add_option("--evidence", mode,
                  "all: store the rows of what is selected; stale: measure and store only stale rows; "
                  "check: only fail if a row is stale")
      ->transform(CLI::CheckedTransformer(modes()));
}

ExitCode report(const Evidence& evidence) {
  const std::vector<std::string> faults = evidence.faults();
  for (const std::string& fault : faults) fmt::print(stderr, "{}\n", fault);
  if (faults.empty()) fmt::print("{} rows of evidence are up to date\n", evidence.today().size());
  return faults.empty() ? ExitCode::equal : ExitCode::differs;
}

}  // namespace halfway::evidence

// SPDX-License-Identifier: Apache-2.0
#include "evidence/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "sim/files/template.hpp"
#include "sim/os/page_part.hpp"

namespace halfway::page {
namespace {

constexpr std::size_t c_shown_digits = 12;  // of a commit

std::string origin_start(std::string_view page) {
  return fmt::format("\nMeasured by `make evidence PAGE={}` at commit ", page);
}

std::string shown(std::string_view commit) {
  return fmt::format("`{}`", commit.substr(0, c_shown_digits));
}

// The cells of a line `| a | b |`; none if it is no such line.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  constexpr std::string_view c_separator = " | ";
  if (!line.starts_with("| ") || !line.ends_with(" |")) return cells;
  const std::string inner = line.substr(2, line.size() - 4);
  for (std::size_t begin = 0; begin <= inner.size();) {
    const std::size_t end = std::min(inner.find(c_separator, begin), inner.size());
    cells.push_back(inner.substr(begin, end - begin));
    begin = end + c_separator.size();
  }
  return cells;
}

}  // namespace

std::string Row::field(std::string_view column) const {
  const auto found = std::ranges::find(fields, column, &Fields::value_type::first);
  return found == fields.end() ? std::string() : found->second;
}

std::string with_sections(std::string_view text, std::span<const Section> sections) {
  std::string page(text);
  if (!page.empty() && page.back() != '\n') page += '\n';
  for (const Section& section : sections) {
    if (auto written = with_page_part(page, section.heading, section.body)) {
      page = std::move(*written);
      continue;
    }
    const std::string mark = fmt::format("\n## {}\n", section.heading);
    const std::string written = fmt::format("{}\n{}", mark, section.body);
    const std::size_t begin = page.find(mark);
    if (begin == std::string::npos) {
      page += written;
      continue;
    }
    const std::size_t next = page.find("\n## ", begin + mark.size() - 1);
    page.replace(begin, (next == std::string::npos ? page.size() : next) - begin, written);
  }
  return page;
}

Status write_sections(const std::filesystem::path& page, std::span<const Section> sections) {
  return rewrite_page(
      page, [&](const std::string& text) { return Result<std::string>(with_sections(text, sections)); });
}

std::vector<Section> sections_of(std::span<const Row> rows) {
  std::vector<Section> sections;
  for (const Row& first : rows) {
    if (std::ranges::find(sections, first.section, &Section::heading) != sections.end()) continue;
    std::vector<std::string> columns;
    for (const auto& [key, value] : first.fields) columns.push_back(key);
    const bool is_whole = columns == std::vector<std::string>{std::string(c_table)};
    std::vector<std::vector<std::string>> cells;
    std::string text;
    for (const Row& row : rows) {
      if (row.section != first.section) continue;
      cells.emplace_back();
      for (const std::string& column : columns) cells.back().push_back(row.field(column));
      if (is_whole) text += cells.back().front();
    }
    sections.push_back({first.section, is_whole ? text : markdown_table(columns, cells)});
  }
  return sections;
}

std::string cell_of(std::string_view text, std::string_view first_cells, std::string_view column) {
  std::vector<std::string> columns;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::string> cells = cells_of(line);
    if (columns.empty()) columns = cells;
    if (cells.empty()) columns.clear();
    const auto at = static_cast<std::size_t>(std::ranges::find(columns, column) - columns.begin());
    std::string start;
    for (std::size_t i = 0; i < cells.size() && start.size() < first_cells.size(); ++i)
      start += (i > 0 ? ", " : "") + cells[i];
    if (!cells.empty() && start == first_cells && at < cells.size()) return cells[at];
  }
  return {};
}

std::string with_origin(std::string_view text, const Origin& origin) {
  std::string page(text);
  const std::string start = origin_start(origin.page);
  const std::string line = fmt::format("{}{} {}\n", start, shown(origin.commit), origin.text);
  if (const std::size_t old = page.find(start); old != std::string::npos)
    return page.replace(old, page.find('\n', old + 1) + 1 - old, line);
  const std::size_t title = page.starts_with("# ") ? 0 : page.find("\n# ");
  const std::size_t end = title == std::string::npos ? title : page.find('\n', title + 1);
  return end == std::string::npos ? line + page : page.insert(end + 1, line);
}

bool is_of_commit(std::string_view text, std::string_view page, std::string_view commit) {
  return text.find(origin_start(page) + shown(commit)) != std::string_view::npos;
}

}  // namespace halfway::page

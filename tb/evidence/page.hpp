// SPDX-License-Identifier: Apache-2.0
// Pages of evidence: Markdown files whose sections are written by programs.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/result.hpp"

namespace halfway::page {

struct Section {
  std::string heading{};  ///< without ##
  std::string body{};     ///< ends with a line feed
};

/// The text with these sections. A section replaces the part of the page between the comments
/// `<!-- HEADING: ... -->` and `<!-- end of HEADING -->`, or the section with the same heading, or is
/// appended.
std::string with_sections(std::string_view text, std::span<const Section> sections);

Status write_sections(const std::filesystem::path& page, std::span<const Section> sections);

/// Columns of a table and their values, in order.
using Fields = std::vector<std::pair<std::string, std::string>>;

/// What was measured of one item of a page: a line of its table.
struct Row {
  std::string name;       ///< unique in its page
  std::string section{};  ///< heading on the page
  Fields fields{};
  std::string details{};  ///< in no column of the table

  std::string field(std::string_view column) const;  ///< empty if there is no such column
};

/// The column of a row that is a whole table in Markdown.
inline constexpr std::string_view c_table = "table as Markdown";

/// One table per section, in the order of the sections' first rows. If the only field is c_table, the values
/// of the section are its text.
std::vector<Section> sections_of(std::span<const Row> rows);

/// The cell of the column in the first row of a table whose first cells are these, separated by ", ". Empty
/// if the text has no such row.
std::string cell_of(std::string_view text, std::string_view first_cells, std::string_view column);

/// What the first line of a page says about its measurement.
struct Origin {
  std::string page;  ///< the name in `make evidence PAGE=...`
  std::string commit;
  std::string text;  ///< date, tools, machine
};

/// The text with the line `Measured by ...` below its title. The line of the same page is replaced.
std::string with_origin(std::string_view text, const Origin& origin);

/// Whether the line `Measured by ...` of this page names the commit.
bool is_of_commit(std::string_view text, std::string_view page, std::string_view commit);

}  // namespace halfway::page

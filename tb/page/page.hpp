// SPDX-License-Identifier: Apache-2.0
// Pages of evidence: Markdown files whose sections are written by programs.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
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

/// The column of a row that is a whole table in Markdown.
inline constexpr std::string_view c_table = "table as Markdown";

}  // namespace halfway::page

// SPDX-License-Identifier: Apache-2.0
// Pages of evidence: Markdown files whose sections are written from results.
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

/// The text with these sections. A section replaces the one with the same heading, or is appended.
std::string with_sections(std::string_view text, std::span<const Section> sections);

Status write_sections(const std::filesystem::path& page, std::span<const Section> sections);

/// A test records this property for a whole table in Markdown.
inline constexpr std::string_view c_table = "table as Markdown";

/// The sections of a result file in GoogleTest's XML. The test suite `edges/HardCases` becomes the section
/// `edges`: a table with one row per test and one column per recorded property, or the tables that its tests
/// record. A suite without recorded properties has no section. It is an error if a test failed, did not run,
/// or does not record the same properties as the first test of its suite. `file` is used in error messages.
Result<std::vector<Section>> read_results(std::string_view file, const std::string& xml);

}  // namespace halfway::page

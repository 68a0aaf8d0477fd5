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
  std::string heading{};  ///< without the ##
  std::string body{};     ///< ends with a line's end
};

/// The text with these sections in it. A section replaces the one with the same heading, or is appended.
std::string with_sections(std::string_view text, std::span<const Section> sections);

Status write_sections(const std::filesystem::path& page, std::span<const Section> sections);

/// The property of a test that records a whole table as Markdown.
inline constexpr std::string_view c_table = "table as Markdown";

/// The sections of a result file: GoogleTest's XML. A test suite `edges/HardCases` is the section `edges`: a
/// table with a row for each test and a column for each property that the tests record, or the tables that
/// its tests record. Suites whose tests all record nothing have no section. It is an error if a test failed,
/// did not run, or does not record the properties that the first test of its suite records. `file` is for
/// errors.
Result<std::vector<Section>> read_results(std::string_view file, const std::string& xml);

}  // namespace halfway::page

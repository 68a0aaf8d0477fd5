// SPDX-License-Identifier: Apache-2.0
// Links of all pages lead to files and headings that exist, README stays short, and figures in its table and
// in the text of docs/accuracy.md are those that commands have measured.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "evidence/evidence.hpp"
#include "sim/synth/pinned.hpp"
#include "sim/system/file.hpp"

namespace halfway {
namespace {

namespace fs = std::filesystem;

const fs::path c_source = HALFWAY_SOURCE_DIR;

// Every Markdown file of the checkout, build folders and dot folders left out.
std::vector<fs::path> all_pages() {
  std::vector<fs::path> pages;
  for (fs::recursive_directory_iterator it(c_source), end; it != end; ++it) {
    const std::string name = it->path().filename();
    if (it->is_directory() && (name == "build" || name.starts_with('.'))) it.disable_recursion_pending();
    if (name.ends_with(".md")) pages.push_back(it->path());
  }
  std::ranges::sort(pages);
  return pages;
}

// The page without comments and code blocks.
std::string prose_of(const fs::path& page) {
  const auto text = read_file(page);
  EXPECT_TRUE(text) << page;
  return text ? std::regex_replace(*text, std::regex("<!--[^]*?-->|```[^]*?```"), "") : std::string();
}

// The anchor that a heading gets: lower case, spaces as hyphens, no punctuation.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading)
    if (c == ' ')
      anchor += '-';
    else if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || (c & 0x80) != 0)
      anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return anchor;
}

std::set<std::string> anchors_of(const fs::path& page) {
  const std::string text = prose_of(page);
  const std::regex heading("(?:^|\n)#+ ([^\n]+)");
  std::set<std::string> anchors;
  for (std::sregex_iterator it(text.begin(), text.end(), heading), end; it != end; ++it)
    anchors.insert(anchor_of((*it)[1]));
  return anchors;
}

TEST(Pages, LinksLeadToFilesAndHeadings) {
  const std::regex link(R"(\]\(([^)#\s]*)(?:#([^)\s]*))?\))");
  for (const fs::path& page : all_pages()) {
    const std::string text = prose_of(page);
    for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) {
      const std::string file = (*it)[1], anchor = (*it)[2];
      if (file.starts_with("http")) continue;
      const fs::path target = file.empty() ? page : page.parent_path() / file;
      ASSERT_TRUE(fs::exists(target)) << page << ": link to " << file;
      if (!anchor.empty()) {
        EXPECT_TRUE(anchors_of(target).contains(anchor)) << page << ": link to " << file << '#' << anchor;
      }
    }
  }
}

// The measured RTL may be older than today's.
TEST(Pages, SpeedNamesTheRtlThatItMeasured) {
  const auto speed = read_file(c_source / "docs/results/speed.md");
  ASSERT_TRUE(speed) << speed.error().message;
  EXPECT_TRUE(std::regex_search(*speed, std::regex("\nRTL: `[0-9a-f]{32}`, ")));
}

TEST(Pages, ReadmeHasAtMostTenKilobytes) {
  EXPECT_LE(fs::file_size(c_source / "README.md"), 10'240U);
}

// A measured value of a row of evidence; empty, with a failure of the test, if there is none.
std::string measured(const fs::path& file, const std::string& name, const std::string& column) {
  const auto rows = evidence::read_rows(c_source / file);
  EXPECT_TRUE(rows) << rows.error().message;
  for (const evidence::Row& row : rows ? *rows : std::vector<evidence::Row>())
    for (const auto& [key, value] : row.fields)
      if (row.name == name && key == column) return value;
  ADD_FAILURE() << file << ": no row " << name << " with a column " << column;
  return {};
}

// The cells of the first table row of the page that starts with this cell.
std::vector<std::string> cells_of(const fs::path& page, const std::string& first) {
  const auto text = read_file(c_source / page);
  EXPECT_TRUE(text) << text.error().message;
  const std::string mark = "\n| " + first + " | ";
  const std::size_t begin = text ? text->find(mark) : std::string::npos;
  EXPECT_NE(begin, std::string::npos) << page << ": no row " << first;
  if (begin == std::string::npos) return {};
  const std::size_t from = begin + mark.size();
  const std::string line = text->substr(from, text->find(" |\n", from) - from);
  std::vector<std::string> cells{first};
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(" | ", at), line.size());
    cells.push_back(line.substr(at, end - at));
    at = end + 3;
  }
  return cells;
}

TEST(Pages, ReadmesShadersHaveTheMeasuredClocksAndErrors) {
  struct Shader {
    const char *name, *design, *row;
  };
  constexpr Shader c_shaders[] = {
      {"quadratic", "quadratic_shader_grey_exact", "quadratic_shader/conservative_test"},
      {"spherical", "spherical_shader_grey_exact", "spherical_shader/ends_on_surface"},
      {"shading processors", nullptr, "shading_processors/exact"}};
  const auto pins = synth::read_pins(c_source / synth::c_pins);
  ASSERT_TRUE(pins) << pins.error().message;
  for (const auto& [name, design, row] : c_shaders) {
    const std::vector<std::string> cells = cells_of("README.md", name);
    ASSERT_EQ(cells.size(), 5U) << name;
    if (design != nullptr) {
      EXPECT_EQ(cells[3], fmt::format("{:.0f} MHz", pins->at(design).mhz)) << synth::c_pins;
    }
    const std::string error = measured("tb/accuracy/evidence.txt", row, "largest error") + "/255";
    EXPECT_EQ(cells[4].substr(0, cells[4].find(',')), error) << row;
  }
}

TEST(Pages, AccuracysBoundsAreTheMeasuredOnes) {
  const std::vector<std::string> cells = cells_of("docs/accuracy.md", "error");
  ASSERT_EQ(cells.size(), 4U);
  const auto value = [](const std::string& preset, const char* column) {
    return measured("tb/bounds/evidence.txt", "Formats_of_preset_" + preset + "/intensity", column);
  };
  const auto bound = [&](const std::string& preset) {
    const std::string text = value(preset, "bound");
    return text.substr(0, text.find(' '));
  };
  const auto rounded = [](const std::string& number, int digits) {
    return fmt::format("{:.{}f}", std::strtod(number.c_str(), nullptr), digits);
  };
  EXPECT_EQ(cells[2],
            fmt::format("at most {}, stated as {}", rounded(value("exact", "derived"), 4), bound("exact")));
  const std::string published =
      fmt::format("at most {}, stated as {}", rounded(value("published", "derived"), 2), bound("published"));
  EXPECT_EQ(cells[3].substr(0, published.size()), published);
  const auto page = read_file(c_source / "docs/accuracy.md");
  ASSERT_TRUE(page) << page.error().message;
  EXPECT_NE(page->find(fmt::format("largest error found (`exact`: {})", rounded(value("exact", "found"), 4))),
            std::string::npos);
}

}  // namespace
}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// Links of all pages lead to files and headings that exist, and README stays short.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "sim/os/file.hpp"
#include "sim/os/test/source_folder.hpp"

namespace halfway {
namespace {

namespace fs = std::filesystem;

// Every Markdown file of the checkout, build folders and dot folders left out.
std::vector<fs::path> all_pages() {
  std::vector<fs::path> pages;
  for (fs::recursive_directory_iterator it(c_source_folder), end; it != end; ++it) {
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

TEST(Pages, ReadmeHasAtMostTenKilobytes) {
  EXPECT_LE(fs::file_size(c_source_folder / "README.md"), 10'240U);
}

}  // namespace
}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// README's figures of speed are those of the page that `make bench` wrote last.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "sim/bench/readme_parts.hpp"
#include "sim/system/file.hpp"
#include "sim/system/page_part.hpp"

namespace halfway {
namespace {

const std::filesystem::path c_source = HALFWAY_SOURCE_DIR;

std::string text_of(const char* page) {
  const auto text = read_file(c_source / page);
  EXPECT_TRUE(text);
  return text ? *text : "";
}

TEST(BenchPage, ReadmesPartsAreDrawnFromIt) {
  const auto parts = readme_parts(text_of("sim/bench/README.md"));
  ASSERT_TRUE(parts) << parts.error().message;
  const std::string readme = text_of("README.md");
  const auto written = with_readme_parts(readme, *parts);
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_TRUE(*written == readme) << "make bench writes them anew; they would be\n"
                                  << parts->speed << '\n'
                                  << parts->sim_line << '\n'
                                  << parts->view;
}

TEST(BenchPage, GivesReadmeItsFigures) {
  const auto parts = readme_parts(text_of("sim/bench/README.md"));
  ASSERT_TRUE(parts) << parts.error().message;
  using ::testing::HasSubstr;
  EXPECT_THAT(parts->speed, HasSubstr("| RTL in lanes, every field compared with the golden model"));
  EXPECT_THAT(parts->speed, HasSubstr("| golden model alone |"));
  EXPECT_THAT(parts->speed, ::testing::Not(HasSubstr("folded")));
  EXPECT_THAT(parts->sim_line, ::testing::StartsWith("```\nspheres "));
}

// What several threads lose is not told without what the machine loses.
TEST(BenchPage, TellsOfCoresBesideTheYardstick) {
  std::string page = text_of("sim/bench/README.md");
  // Of as many threads as the machine of the page had.
  const std::size_t cores = page.find("\n## Cores"), behind = page.find("\n## ", cores + 1);
  const std::size_t begin = page.rfind("\n| quadratic | ", behind), end = page.find('\n', begin + 1);
  ASSERT_TRUE(cores != page.npos && behind != page.npos && begin != page.npos && begin > cores);
  const std::string row = page.substr(begin, end - begin), head = "\n| quadratic | ";
  const std::string threads = row.substr(head.size(), row.find(' ', head.size()) - head.size());
  page.replace(begin, end - begin, head + threads + " | 2.00 | 50.0 % | 1.50 | 51.5 % | 97.1 % |");
  const auto parts = readme_parts(page);
  ASSERT_TRUE(parts) << parts.error().message;
  std::string speed = parts->speed;
  std::ranges::replace(speed, '\n', ' ');
  EXPECT_THAT(speed,
              ::testing::ContainsRegex(
                  "On " + threads +
                  " threads each core is 50.0 % .quadratic. and [0-9.]+ % .spherical. as fast as one "
                  "alone, where work in registers alone, which shares nothing, is 51.5 % and [0-9.]+ %"));
  page.replace(begin, page.find('\n', begin + 1) - begin, head + threads + " | 2.00 | 50.0 % | 1.50 |");
  for (std::size_t other; (other = page.find(head, cores)) < page.find(head + threads, cores);)
    page.erase(other, page.find('\n', other + 1) - other);
  EXPECT_FALSE(readme_parts(page));
}

// A part of the measurements has no place in README.
TEST(BenchPage, IsWholeOrNotTaken) {
  const std::string page = text_of("sim/bench/README.md");
  for (const char* heading :
       {"## Ways to a picture", "## Growth", "### Pixels, spherical shader",
        "### Triangles, quadratic shader", "## Small triangles", "## Cores", "## End to end", "## View"}) {
    std::string part = page;
    const std::size_t begin = part.find(heading);
    ASSERT_NE(begin, part.npos) << heading;
    part.erase(begin, part.find("\n#", begin) - begin);
    const auto parts = readme_parts(part);
    ASSERT_FALSE(parts) << heading;
    EXPECT_THAT(parts.error().message, ::testing::StartsWith("sim/bench/README.md: has no "));
  }
}

}  // namespace
}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// README's figures of speed are those of the page that `make bench` wrote last.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "bench/readme_parts.hpp"
#include "common/file.hpp"
#include "common/page_part.hpp"

namespace halfway {
namespace {

const std::filesystem::path c_source = HALFWAY_SOURCE_DIR;

std::string text_of(const char* page) {
  const auto text = read_file(c_source / page);
  EXPECT_TRUE(text);
  return text ? *text : "";
}

TEST(BenchPage, ReadmesPartsAreDrawnFromIt) {
  const auto parts = readme_parts(text_of("model/bench/README.md"));
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
  const auto parts = readme_parts(text_of("model/bench/README.md"));
  ASSERT_TRUE(parts) << parts.error().message;
  using ::testing::HasSubstr;
  EXPECT_THAT(parts->speed, HasSubstr("| RTL in lanes, every field compared with the golden model"));
  EXPECT_THAT(parts->speed, HasSubstr("| golden model alone |"));
  EXPECT_THAT(parts->speed, ::testing::Not(HasSubstr("folded")));
  EXPECT_THAT(parts->sim_line, ::testing::StartsWith("```\nspheres "));
}

// A part of the measurements has no place in README.
TEST(BenchPage, IsWholeOrNotTaken) {
  const std::string page = text_of("model/bench/README.md");
  for (const char* heading :
       {"## Ways to a picture", "## Growth", "### Pixels, spherical shader",
        "### Triangles, quadratic shader", "## Small triangles", "## End to end", "## View"}) {
    std::string part = page;
    const std::size_t begin = part.find(heading);
    ASSERT_NE(begin, part.npos) << heading;
    part.erase(begin, part.find("\n#", begin) - begin);
    const auto parts = readme_parts(part);
    ASSERT_FALSE(parts) << heading;
    EXPECT_THAT(parts.error().message, ::testing::StartsWith("model/bench/README.md: has no "));
  }
}

}  // namespace
}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
#include "sim/os/page_part.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "common/test/is_error.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

constexpr std::string_view c_page =
    "# Page\n\n<!-- one: written by make one -->\n\nfirst\n\nsecond\n\n<!-- end of one -->\n\nrest\n"
    "<!-- two: none -->\n<!-- end of two -->\n";

TEST(PagePart, IsReplacedWithoutOtherChanges) {
  const auto page = must(with_page_part(c_page, "one", "new\n"));
  EXPECT_EQ(page,
            "# Page\n\n<!-- one: written by make one -->\n\nnew\n\n<!-- end of one -->\n\nrest\n"
            "<!-- two: none -->\n<!-- end of two -->\n");
  const auto again = must(with_page_part(page, "one", "new\n"));
  EXPECT_EQ(again, page);
  const auto both = must(with_page_part(page, "two", "more\n"));
  EXPECT_EQ(both,
            "# Page\n\n<!-- one: written by make one -->\n\nnew\n\n<!-- end of one -->\n\nrest\n"
            "<!-- two: none -->\n\nmore\n\n<!-- end of two -->\n");
}

TEST(PagePart, ExistsOnceAndHasAnEnd) {
  for (const std::string& page : {std::string("# Page\n"), std::string("\n<!-- one: by make -->\ntext\n"),
                                  std::string("\n<!-- end of one -->\n<!-- one: by make -->\n"),
                                  std::string(c_page) + std::string(c_page)}) {
    EXPECT_TRUE(is_error(with_page_part(page, "one", "new\n"), "'<!-- end of one -->'")) << page;
  }
}

TEST(PagePart, IsRewrittenInItsFileOrTheFileIsUnchanged) {
  const auto folder = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
  const std::filesystem::path path = folder.path() / "page.md";
  const auto with_one = [](const char* name) {
    return [name](const std::string& page) { return with_page_part(page, name, "new\n"); };
  };
  EXPECT_FALSE(rewrite_page(path, with_one("one"))) << "there is no page";
  ASSERT_TRUE(write_file(path, std::string(c_page)));
  const Status failed = rewrite_page(path, with_one("three"));
  ASSERT_FALSE(failed);
  EXPECT_THAT(failed.error().message, ::testing::StartsWith(path.string() + ": wants one part"));
  EXPECT_EQ(*read_file(path), c_page);
  ASSERT_TRUE(rewrite_page(path, with_one("one")));
  EXPECT_EQ(*read_file(path), *with_page_part(c_page, "one", "new\n"));
}

}  // namespace
}  // namespace halfway

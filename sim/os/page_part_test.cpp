// SPDX-License-Identifier: Apache-2.0
#include "sim/os/page_part.hpp"

#include <gtest/gtest.h>

#include "common/test/is_error.hpp"
#include "sim/os/test/folder_test.hpp"

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

using PagePartOfFile = FolderTest;

TEST_F(PagePartOfFile, IsRewrittenOrTheFileIsUnchanged) {
  const std::filesystem::path path = at("page.md");
  const auto with_one = [](const char* name) {
    return [name](const std::string& page) { return with_page_part(page, name, "new\n"); };
  };
  EXPECT_FALSE(rewrite_page(path, with_one("one"))) << "there is no page";
  write(path, c_page);
  EXPECT_TRUE(is_error(rewrite_page(path, with_one("three")), path.string() + ": wants one part"));
  EXPECT_EQ(text_of(path), c_page);
  ASSERT_TRUE(rewrite_page(path, with_one("one")));
  EXPECT_EQ(text_of(path), *with_page_part(c_page, "one", "new\n"));
}

}  // namespace
}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
#include "page/page.hpp"

#include <gtest/gtest.h>

namespace halfway::page {
namespace {

TEST(Page, SectionsAreReplacedInPlaceOrAppended) {
  const std::string page = "# Page\n\nIntro.\n\n## one\n\nold\n\n## two\n\nkept\n";
  const Section sections[] = {{"one", "new\n"}, {"three", "added\n"}};
  const std::string written = with_sections(page, sections);
  EXPECT_EQ(written, "# Page\n\nIntro.\n\n## one\n\nnew\n\n## two\n\nkept\n\n## three\n\nadded\n");
  EXPECT_EQ(with_sections(written, sections), written);
  const Section last[] = {{"two", "other\n"}};
  EXPECT_EQ(with_sections(page, last), "# Page\n\nIntro.\n\n## one\n\nold\n\n## two\n\nother\n");
}

TEST(Page, PartsBetweenCommentsAreReplacedInPlace) {
  const std::string page =
      "# Page\n\n## one\n\nText.\n\n<!-- one: written by x -->\n\nold\n\n<!-- end of one -->\n\nMore.\n";
  const Section sections[] = {{"one", "new\n"}};
  const std::string written = with_sections(page, sections);
  EXPECT_EQ(
      written,
      "# Page\n\n## one\n\nText.\n\n<!-- one: written by x -->\n\nnew\n\n<!-- end of one -->\n\nMore.\n");
  EXPECT_EQ(with_sections(written, sections), written);
}

}  // namespace
}  // namespace halfway::page

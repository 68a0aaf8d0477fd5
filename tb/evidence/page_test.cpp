// SPDX-License-Identifier: Apache-2.0
#include "evidence/page.hpp"

#include <gtest/gtest.h>

#include "evidence/study_table.hpp"

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

TEST(Page, RowsAreATablePerSection) {
  const Row rows[] = {{"a", "one", {{"x", "1"}, {"y", "2"}}},
                      {"b", "two", {{std::string(c_table), "| whole |\n"}}},
                      {"c", "one", {{"y", "4"}, {"x", "3"}}}};
  const auto sections = sections_of(rows);
  ASSERT_EQ(sections.size(), 2U);
  EXPECT_EQ(sections[0].heading, "one");
  EXPECT_EQ(sections[0].body, "| x | y |\n| --- | --- |\n| 1 | 2 |\n| 3 | 4 |\n");
  EXPECT_EQ(sections[1].body, "| whole |\n");
}

TEST(Page, HasTheCellOfARow) {
  const char* text =
      "| a | b |\n| --- | --- |\n| x | 1 |\n\nText.\n\n| a | c | d |\n| --- | --- | --- |\n| x | y | 2 |\n| "
      "x | z | 3 |\n";
  EXPECT_EQ(cell_of(text, "x", "b"), "1");
  EXPECT_EQ(cell_of(text, "x, z", "d"), "3");
  EXPECT_EQ(cell_of(text, "x, w", "d"), "");
  EXPECT_EQ(cell_of(text, "x, y", "b"), "");
}

TEST(Page, NamesItsCommitBelowItsTitle) {
  const std::string page = "<!-- licence -->\n# Page\n\nIntro.\n";
  const std::string once = with_origin(page, {"proofs", "0123456789abcdef", "on Monday."});
  EXPECT_EQ(once,
            "<!-- licence -->\n# Page\n\nMeasured by `make evidence PAGE=proofs` at commit `0123456789ab` on "
            "Monday.\n\nIntro.\n");
  EXPECT_TRUE(is_of_commit(once, "proofs", "0123456789abcdef"));
  EXPECT_FALSE(is_of_commit(once, "proofs", "1123456789abcdef"));
  EXPECT_FALSE(is_of_commit(once, "mutants", "0123456789abcdef"));
  // A page can have a line for each of two measurements.
  const std::string twice = with_origin(once, {"gallery", "0123456789abcdef", "on Tuesday."});
  EXPECT_EQ(
      with_origin(twice, {"proofs", "fedcba9876543210", "on Friday."}),
      "<!-- licence -->\n# Page\n\nMeasured by `make evidence PAGE=gallery` at commit `0123456789ab` on "
      "Tuesday.\n\nMeasured by `make evidence PAGE=proofs` at commit `fedcba987654` on Friday.\n\nIntro.\n");
}

TEST(StudyTable, OmitsColumnsOfOneValue) {
  const std::vector<std::string> columns = {"point", "cycles", "largest_error", "rms", "scene", "unused"};
  const Table tables[] = {{columns, {{"a", "120", "2", "0.123456", "near", "x"}}},
                          {columns, {{"b", "120", "2", "1.218e+06", "far", "y"}}}};
  EXPECT_EQ(study_table(tables),
            "| scene | design | rms error | largest error |\n| --- | --- | --- | --- |\n"
            "| near | a | 0.1235 | 2 |\n| far | b | 1218000 | 2 |\n");
}

}  // namespace
}  // namespace halfway::page

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

std::string results(std::string_view tests) {
  return "<testsuites><testsuite name=\"two_words/Suite\">" + std::string(tests) +
         "</testsuite></testsuites>";
}
std::string result(std::string_view name, std::string_view properties,
                   std::string_view attributes = R"(result="completed")") {
  return "<testcase name=\"" + std::string(name) + "\" " + std::string(attributes) + "><properties>" +
         std::string(properties) + "</properties></testcase>";
}
constexpr std::string_view c_row = R"(<property name="case" value="γ"/><property name="a, b" value="1"/>)";

TEST(Results, BecomeATableForEachSuite) {
  const auto sections = read_results("r.xml", results(result("x", c_row) + result("y", c_row)));
  ASSERT_TRUE(sections) << sections.error().message;
  ASSERT_EQ(sections->size(), 1U);
  EXPECT_EQ(sections->front().heading, "two words");
  EXPECT_EQ(sections->front().body, "| case | a, b |\n| --- | --- |\n| γ | 1 |\n| γ | 1 |\n");
}

TEST(Results, MayBeAWholeTable) {
  const std::string body = "| a | b |\n| --- | --- |\n| 1 | 2 |\n";
  std::string escaped;  // as GoogleTest writes it
  for (const char c : body) escaped += c == '\n' ? std::string("&#x0A;") : std::string(1, c);
  const auto sections = read_results("r.xml", results(result("x", "<property name=\"" + std::string(c_table) +
                                                                      "\" value=\"" + escaped + "\"/>")));
  ASSERT_TRUE(sections) << sections.error().message;
  EXPECT_EQ(sections->front().body, body);
}

TEST(Results, AreNoPageWhereATestFailedOrHasNoRow) {
  const auto message = [](const std::string& xml) {
    const auto sections = read_results("r.xml", xml);
    return sections ? std::string("none") : sections.error().message;
  };
  const std::string good = result("x", c_row);
  EXPECT_EQ(message(results(good + result("y", c_row, R"(result="skipped")"))),
            "r.xml: two_words/Suite.y did not run");
  EXPECT_EQ(message(results(good + R"(<testcase name="y" result="completed"><failure/></testcase>)")),
            "r.xml: two_words/Suite.y failed");
  EXPECT_EQ(message(results(result("x", ""))), "r.xml: no test records a property");
  EXPECT_EQ(message(results(result("x", "") + good)),
            "r.xml: two_words/Suite.x records other properties than the suite's first test");
  EXPECT_EQ(message(results(good + result("y", R"(<property name="case" value="1"/>)"))),
            "r.xml: two_words/Suite.y records other properties than the suite's first test");
  EXPECT_EQ(message("<testsuites/>"), "r.xml: no test records a property");
  EXPECT_TRUE(message("<testsuites>").starts_with("r.xml: ")) << message("<testsuites>");
}

}  // namespace
}  // namespace halfway::page

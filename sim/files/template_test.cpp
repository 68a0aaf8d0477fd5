// SPDX-License-Identifier: Apache-2.0
#include "sim/files/template.hpp"

#include <gtest/gtest.h>

#include "common/test/is_error.hpp"
#include "sim/os/test/folder_test.hpp"

namespace halfway {
namespace {

class Template : public FolderTest {
 protected:
  Result<std::string> filled(const std::string& text, const nlohmann::ordered_json& data,
                             Escape escape = Escape::bars) const {
    return filled_template(write("page.md.mustache", text), data, escape);
  }
};

TEST_F(Template, IsFilledWithTextsNumbersListsAndObjects) {
  const auto page = must(
      filled("{{n}} of {{x.name}}\n{{#rows}}\n| {{cell}} | {{#wide}}wide{{/wide}}{{^wide}}narrow{{/wide}} "
             "|\n{{/rows}}\n\nend\n",
             {{"n", 3},
              {"x", {{"name", "α"}}},
              {"rows", {{{"cell", "a|b"}, {"wide", true}}, {{"cell", "1.5"}, {"wide", false}}}}}));
  EXPECT_EQ(page, "3 of α\n| a\\|b | wide |\n| 1.5 | narrow |\n\nend\n");
  EXPECT_EQ(
      must(filled("{{{text}}}{{#none}}x{{/none}}", {{"text", "a|<b>"}, {"none", nlohmann::json::array()}})),
      "a|<b>");
  EXPECT_EQ(must(filled("{{text}} {{{text}}}{{#none}}x{{/none}}", {{"text", "<|>"}, {"none", nullptr}},
                        Escape::html)),
            "&lt;|&gt; <|>");
}

TEST_F(Template, MustBeCompleteAndUseOnlyExistingData) {
  EXPECT_TRUE(is_error(filled("{{#rows}}{{b}}{{/rows}}", {{"rows", {{{"a", 1}}}}}),
                       "page.md.mustache: the data has no 'b'"));
  EXPECT_FALSE(filled("{{#rows}}", {{"rows", true}}));
}

TEST(MarkdownTable, HasALineForEachRow) {
  const std::string columns[] = {"a", "b"};
  const std::vector<std::string> rows[] = {{"1", "2"}, {"3", "4"}};
  EXPECT_EQ(markdown_table(columns, rows), "| a | b |\n| --- | --- |\n| 1 | 2 |\n| 3 | 4 |\n");
}

}  // namespace
}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
#include "sim/report/html.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/os/must.hpp"

namespace halfway::report {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Html, TextsBecomePartsOfThePage) {
  EXPECT_EQ(script_safe("{\"a\": \"</script><!--\"}"), "{\"a\": \"\\u003c/script>\\u003c!--\"}");
  const std::string html = from_markdown(
      "<!-- SPDX -->\n# Title\n\nSee [`here`](../there/README.md) and [there](https://example.org/).\n\n"
      "![a picture](x.png)\n\n| a | b |\n| --- | --- |\n| 1 | < 2 |\n",
      "A \"name\"");
  for (const char* part : {"<h3>Title</h3>", "See <code>here</code> and", "a picture", "<td>&lt; 2</td>",
                           "<a href=\"https://example.org/\">there</a>", "</table></div>",
                           "aria-label=\"A &quot;name&quot;: table\" tabindex=\"0\"><table>"})
    EXPECT_THAT(html, HasSubstr(part));
  for (const char* part : {"SPDX", "README", "<img"}) EXPECT_THAT(html, Not(HasSubstr(part)));
}

TEST(Html, SvgsBecomeElementsOfThePage) {
  const std::string svg = inline_svg(
      "<?xml version=\"1.0\"?><!DOCTYPE svg><svg xmlns=\"http://www.w3.org/2000/svg\" width=\"20\" "
      "height=\"10\">"
      "<title>T</title><defs><g id=\"mark\"/></defs><use href=\"#mark\" stroke=\"black\"/>"
      "<rect fill=\"url(#mark)\"/><rect fill=\"white\"/><a href=\"#point-3\"/></svg>",
      "p-", "a < b");
  EXPECT_THAT(svg, AllOf(HasSubstr("viewBox=\"0 0 20 10\""), HasSubstr("style=\"--width: 20px\""),
                         HasSubstr("role=\"img\" aria-label=\"a &lt; b\""), HasSubstr("id=\"p-mark\""),
                         HasSubstr("href=\"#p-mark\" stroke=\"currentColor\""), HasSubstr("url(#p-mark)"),
                         HasSubstr("fill=\"none\""), HasSubstr("href=\"#point-3\"")));
  EXPECT_THAT(svg, AllOf(Not(HasSubstr("<?xml")), Not(HasSubstr("DOCTYPE")), Not(HasSubstr("width=")),
                         Not(HasSubstr("<title>"))));
  EXPECT_THROW(inline_svg("<p>none</p>", "p-", ""), Failure);
}

}  // namespace
}  // namespace halfway::report

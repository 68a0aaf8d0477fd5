// SPDX-License-Identifier: Apache-2.0
#include "sim/study/savings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/os/must.hpp"

namespace halfway {
namespace {

using ::testing::HasSubstr;

TEST(Savings, AreDrawnAsSharesAndPairs) {
  std::vector<Savings> savings(savings_cases().size());
  savings[1] = {{{.luts = 1326, .flip_flops = 90}}, {{.luts = 53376, .flip_flops = 100}}};
  savings[4] = {{{.luts = 4682, .multipliers = 15}, 19739}, {{.luts = 19557, .multipliers = 92}, 44464}};
  const std::string text = with_savings(
      "\n<!-- savings: x -->\n\n<!-- end of savings -->\n\n<!-- savings of processors: x -->\n\n<!-- end of "
      "savings of "
      "processors -->\n",
      savings);
  EXPECT_THAT(text, HasSubstr("\n| `matte` | spherical, `published` | 1326 | 53 376 | 98 % | 10 % |\n"));
  EXPECT_THAT(
      text,
      HasSubstr("\n| `matte`, `exact` | 4682 / 19 557 | 15 / 92 | 0 / 0 | 0 / 0 | 19 739 / 44 464 |\n"));
  EXPECT_THROW(with_savings("a page without parts", savings), Failure);
}

}  // namespace
}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// Tests of the command `halfway figures`. The figures themselves are checked by the test `figures`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/cli/command_test.hpp"

namespace halfway {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

using FiguresCommand = CommandTest;

TEST_F(FiguresCommand, WritesThePageAndItsDataOfWhatIsAskedFor) {
  EXPECT_THAT(
      run({"figures", "spherical-table", "--out", "drawn"}),
      Ends(0, AllOf(HasSubstr("2.7582, 4.3143, 6.0791, 13.5535: agrees (the same)"),
                    HasSubstr("drawn: 1 figures, 2 rows, 1 agree, 0 differ, 1 hold by construction"))));
  for (const char* file : {"drawn/README.md", "drawn/figures.json"})
    EXPECT_THAT(text_of(file), HasSubstr("2.7582"));
}

TEST_F(FiguresCommand, RefusesWhatItDoesNotKnow) {
  EXPECT_THAT(run({"figures", "spherical-8"}),
              Ends(2, AllOf(HasSubstr("'spherical-8' is not a figure"), HasSubstr("spherical-16"))));
  EXPECT_EQ(run({"figures", "--quick", "--page", "there"}).exit_code, 2);
}

TEST_F(FiguresCommand, SaysWhatBringsGnuplot) {
  EXPECT_THAT(run({"figures", "spherical-09"}, {{"PATH", here().string()}}),
              Ends(3, HasSubstr("gnuplot: not found; install it with: apt-get install gnuplot-nox")));
}

// A checkout whose table 1 has another number.
TEST_F(FiguresCommand, FindsAClaimThatIsNotMeasured) {
  for (const char* file : {"sim/figures/claims.toml", "sim/figures/figures.md.mustache"})
    write(std::filesystem::path("source") / file, text_of(c_source_folder / file));
  replace_in(at("source/sim/figures/claims.toml"), "1.9845, 2.7582, 4.3143", "1.9845, 2.7584, 4.3143");
  EXPECT_THAT(
      run({"--source", at("source"), "figures", "spherical-table", "--page", "there"}),
      Ends(1, AllOf(HasSubstr("differs, and no reason is known: published 1.0000, 1.4502, 1.9845, 2.7584"),
                    HasSubstr("claims.toml does not match"))));
  EXPECT_FALSE(std::filesystem::exists(at("there")));
}

}  // namespace
}  // namespace halfway

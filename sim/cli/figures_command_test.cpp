// SPDX-License-Identifier: Apache-2.0
// Tests of the command `halfway figures`. The figures themselves are checked by the test `figures`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "sim/cli/command_test.hpp"
#include "sim/system/file.hpp"
#include "sim/system/must.hpp"

namespace halfway {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

using FiguresCommand = CommandTest;

TEST_F(FiguresCommand, WritesThePageAndItsDataOfWhatIsAskedFor) {
  EXPECT_THAT(run({"figures", "spherical-table", "--out", "drawn"}),
              Ends(0, AllOf(HasSubstr("a for n = 20: published 2.7582, measured 2.7582: agrees (± 0.00005)"),
                            HasSubstr("drawn: 1 figures, 8 rows, 8 agree, 0 differ"))));
  for (const char* name : {"README.md", "figures.json"}) {
    const auto text = must(read_file(folder_.path() / "drawn" / name));
    EXPECT_THAT(text, HasSubstr("2.7582"));
  }
}

TEST_F(FiguresCommand, RefusesWhatItDoesNotKnow) {
  EXPECT_THAT(run({"figures", "spherical-8"}),
              Ends(2, AllOf(HasSubstr("'spherical-8' is not a figure"), HasSubstr("spherical-16"))));
  EXPECT_EQ(run({"figures", "--check", "--page", "there"}).exit_code, 2);
  EXPECT_EQ(run({"figures", "--check", "spherical"}).exit_code, 2);
}

TEST_F(FiguresCommand, SaysWhatBringsGnuplot) {
  EXPECT_THAT(run({"figures", "spherical-09"}, {{"PATH", folder_.path().string()}}),
              Ends(3, HasSubstr("gnuplot: not found; install it with: apt-get install gnuplot-nox")));
}

// A checkout with a changed number in the committed table.
TEST_F(FiguresCommand, ACheckFindsANumberThatIsNotMeasured) {
  namespace fs = std::filesystem;
  const fs::path real = HALFWAY_SOURCE_DIR, source = folder_.path() / "source";
  fs::create_directories(source / "sim");
  fs::create_directories(source / "build");
  for (const char* name : {"rtl", "tb", "sim/scenes", "sim/figures", "build/cache"})
    fs::create_directory_symlink(real / name, source / name);
  fs::create_directories(source / "docs/results");
  fs::copy(real / "docs/results/figures", source / "docs/results/figures");
  const fs::path json = source / "docs/results/figures/figures.json";
  auto text = must(read_file(json));
  const std::string measured = "\"measured\": \"2.7582\"";
  const std::size_t at = text.find(measured);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, measured.size(), "\"measured\": \"2.7583\"");
  ASSERT_TRUE(write_file(json, text));
  EXPECT_THAT(run({"--source", source.string(), "figures", "--check", "--threads", "2"}),
              Ends(1, AllOf(HasSubstr("is 2.7583 there, measured 2.7582"),
                            HasSubstr("figures.json differs from the text that make figures writes"),
                            HasSubstr("run make figures"))));
}

}  // namespace
}  // namespace halfway

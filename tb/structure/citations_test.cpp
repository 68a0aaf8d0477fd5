// SPDX-License-Identifier: Apache-2.0
#include "structure/citations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "sim/system/file.hpp"

namespace halfway::structure {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Citations, ArePlacesOfThePapers) {
  const std::filesystem::path source = HALFWAY_SOURCE_DIR;
  std::size_t count = 0;
  std::vector<std::string> wrong;
  const auto check = [&](const std::filesystem::path& file) {
    const auto text = read_file(source / file);
    ASSERT_TRUE(text) << file;
    count += count_citations(*text);
    for (std::string& fault : wrong_citations(file.string(), *text)) wrong.push_back(std::move(fault));
  };
  for (const char* page : {"README.md", "CHANGELOG.md", "CONTRIBUTING.md"}) check(page);
  for (const char* top : {"rtl", "model", "sim", "tb", "docs"})
    for (const char* ending : {".vhd", ".cpp", ".hpp", ".md", ".toml", ".mustache"}) {
      const auto files = files_below(source / top, ending);
      ASSERT_TRUE(files) << top;
      for (const std::filesystem::path& file : *files)
        if (!file.filename().string().starts_with("citations")) check(top / file);
    }
  EXPECT_THAT(wrong, IsEmpty());
  EXPECT_GT(count, 200U);
}

TEST(Citations, AFigureIsInTheSectionBeforeIt) {
  EXPECT_THAT(wrong_citations("a.vhd", "x\n-- Source      spherical paper, section 5 and figure 12\n"),
              ElementsAre("a.vhd:2: spherical paper: figure 12 is in section 4, not in 5"));
  EXPECT_THAT(wrong_citations("a.vhd",
                              "-- spherical paper, section 3 (the pair), section 3.1 and\n"
                              "--             equations 15 to 17"),
              ElementsAre("a.vhd:1: spherical paper: equation 15 is in section 3.2, not in 3.1",
                          "a.vhd:1: spherical paper: equation 16 is in section 3.2, not in 3.1",
                          "a.vhd:1: spherical paper: equation 17 is in section 3.2, not in 3.1"));
  EXPECT_THAT(wrong_citations("a.vhd",
                              "-- spherical paper, figure 12; section 5 and figure 13. quadratic, "
                              "section 5, figure 6 and equation 5"),
              IsEmpty());
}

TEST(Citations, APlaceExists) {
  EXPECT_THAT(wrong_citations("a.hpp", "/// figures 9 to 12 of the quadratic paper"),
              ElementsAre("a.hpp:1: quadratic paper: there is no figure 12"));
  EXPECT_THAT(wrong_citations("a.cpp", "{\"processors, equation 3 \"\n \"and section 3.4\"}"),
              ElementsAre("a.cpp:1: processors paper: there is no section 3.4"));
}

TEST(Citations, ASubjectIsInItsPlace) {
  EXPECT_THAT(wrong_citations("a.cpp", "\n\"spherical, equation 4: H = (L + V)/abs(L + V)\""),
              ElementsAre("a.cpp:2: spherical paper: 'L + V' is in equation 6"));
  EXPECT_THAT(
      wrong_citations("a.cpp", "\"spherical, equation 6: H = (L + V)\", \"processors, section 4: x\""),
      IsEmpty());
  EXPECT_THAT(wrong_citations("a.vhd", "-- processors paper, section 4 (the power by a table)"),
              ElementsAre("a.vhd:1: processors paper: 'power by a table' is in figure 1"));
}

}  // namespace
}  // namespace halfway::structure

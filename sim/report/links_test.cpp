// SPDX-License-Identifier: Apache-2.0
// Links and pictures in the Markdown pages must point to existing files.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

namespace halfway {
namespace {

const std::filesystem::path c_source = HALFWAY_SOURCE_DIR;

class Links : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Of, Links,
                         ::testing::Values("README.md", "rtl/README.md", "model/README.md",
                                           "sim/bench/README.md", "sim/README.md", "sim/lanes/README.md",
                                           "sim/scenes/README.md", "sim/studies/README.md",
                                           "tb/synth/README.md", "sim/figures/README.md"),
                         [](const auto& page) {
                           return std::regex_replace(std::string(page.param), std::regex("[^a-zA-Z]"), "_");
                         });

TEST_P(Links, LeadToFiles) {
  const std::filesystem::path page = c_source / GetParam();
  std::ifstream stream(page);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  ASSERT_FALSE(text.empty()) << page;
  text = std::regex_replace(text, std::regex("<!--[^]*?-->|```[^]*?```"), "");
  const std::regex link(R"(\]\(([^)#\s]+)[^)]*\))");
  for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) {
    const std::string target = (*it)[1];
    if (target.starts_with("http")) continue;
    EXPECT_TRUE(std::filesystem::exists(page.parent_path() / target)) << target;
  }
}

}  // namespace
}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// The examples of a pixel's stages on the pages of docs/rtl must equal the output of `halfway why`.
#include <gtest/gtest.h>

#include <sstream>

#include "sim/cli/command_test.hpp"

namespace halfway {
namespace {

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// The text with single spaces, because columns may have different widths.
std::string squeezed(const std::string& text) {
  std::string out;
  for (const std::string& word : words_of(text)) out += word + ' ';
  return out;
}

using PixelWalk = CommandTest;

TEST_F(PixelWalk, EqualsTheOutputOfWhy) {
  const std::string mark = "\n```\n$ build/halfway why ";
  for (const char* name : {"quadratic", "spherical", "processors"}) {
    SCOPED_TRACE(name);
    const std::string page = text_of(c_source_folder / "docs/rtl" / (std::string(name) + ".md"));
    const std::size_t at = page.find(mark);
    ASSERT_NE(at, std::string::npos);
    const std::size_t begin = at + std::string("\n```\n$ build/halfway ").size();
    std::istringstream block(page.substr(begin, page.find("\n```", begin) - begin));
    std::string line;
    std::getline(block, line);
    std::vector<std::string> command = words_of(line);
    ASSERT_GT(command.size(), 2U);
    command[1] = c_source_folder / command[1];
    const Outcome outcome = run(command);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    // Each line of the block, in this order.
    const std::string output = squeezed(outcome.output);
    std::size_t after = 0;
    int lines = 0;
    for (; std::getline(block, line); ++lines) {
      after = output.find(squeezed(line), after);
      ASSERT_NE(after, std::string::npos) << line << "\n" << outcome.output;
    }
    EXPECT_GT(lines, 5);
  }
}

}  // namespace
}  // namespace halfway

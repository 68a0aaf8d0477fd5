// SPDX-License-Identifier: Apache-2.0
// The traces of one pixel in rtl/README.md must equal the output of `halfway why`.
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

// The text with runs of spaces reduced to one, so that column widths do not matter.
std::string squeezed(const std::string& text) {
  std::string out;
  for (const std::string& word : words_of(text)) out += word + ' ';
  return out;
}

class PixelWalk : public CommandTest {};

TEST_F(PixelWalk, IsWhatWhyPrints) {
  const std::filesystem::path source = HALFWAY_SOURCE_DIR;
  const auto page = read_file(source / "rtl/README.md");
  ASSERT_TRUE(page);
  const std::string mark = "\n```\n$ halfway ";
  int walks = 0;
  for (std::size_t at = 0; (at = page->find(mark, at)) != std::string::npos; ++walks) {
    at += mark.size();
    std::istringstream block(page->substr(at, page->find("\n```", at) - at));
    std::string line;
    std::getline(block, line);
    SCOPED_TRACE(line);
    std::vector<std::string> command = words_of(line);
    ASSERT_GT(command.size(), 2U);
    command[1] = source / command[1];
    const Outcome outcome = run(command);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    // The output contains each line of the block, in this order.
    const std::string output = squeezed(outcome.output);
    std::size_t after = 0;
    while (std::getline(block, line)) {
      after = output.find(squeezed(line), after);
      ASSERT_NE(after, std::string::npos) << line << "\n" << outcome.output;
    }
  }
  EXPECT_EQ(walks, 3);
}

}  // namespace
}  // namespace halfway

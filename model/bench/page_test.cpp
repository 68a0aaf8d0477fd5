// SPDX-License-Identifier: Apache-2.0
// README's figures of speed are those of the page that `make bench` wrote last.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "common/file.hpp"

namespace halfway {
namespace {

std::string text_of(const char* page) {
  const auto text = read_file(std::filesystem::path(HALFWAY_SOURCE_DIR) / page);
  return text ? *text : "";
}

/// A heading and what stands below it, up to the next one of its kind.
std::string section(const std::string& text, const std::string& heading) {
  const std::size_t begin = text.find("\n" + heading + "\n");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find("\n## ", begin + heading.size()) - begin);
}

std::vector<std::string> found_in(const std::string& text, const char* pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> all;
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it)
    all.push_back((*it)[1]);
  return all;
}

TEST(BenchPage, ReadmesTimesAreItsTimes) {
  const std::string page = section(text_of("model/bench/README.md"), "## Ways to a picture");
  // README leaves the folded processors, the last column, out.
  const char* const c_row = R"(\n(\| [A-Za-z][^|\n]*(?:\|[^|\n]*\d[^|\n]*){2}\|[^|\n]*\|))";
  const std::vector<std::string> times = found_in(page, c_row);
  ASSERT_GE(times.size(), 8U);
  std::vector<std::string> expected;
  for (const std::string& row : times)
    if (!row.starts_with("| frame;")) expected.push_back(row);
  EXPECT_EQ(found_in(section(text_of("README.md"), "## Speed"), c_row), expected);
}

TEST(BenchPage, ReadmesGrowthIsThatOfItsLines) {
  const std::vector<std::string> deviations =
      found_in(text_of("model/bench/README.md"), R"(at most ([0-9.]+) % beside that line)");
  ASSERT_EQ(deviations.size(), 6U);  // triangles, pixels, lights, two shaders each
  const auto worst = [&](std::size_t i) {
    return std::stod(deviations[i]) > std::stod(deviations[i + 1]) ? deviations[i] : deviations[i + 1];
  };
  std::string readme = section(text_of("README.md"), "## Speed");
  readme = std::regex_replace(readme, std::regex("\n"), " ");
  EXPECT_NE(readme.find("within " + worst(0) + ", " + worst(2) + " and " + worst(4) +
                        " % of a line and a constant"),
            std::string::npos)
      << worst(0) << ", " << worst(2) << ", " << worst(4);
}

}  // namespace
}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
#include "sim/system/machine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "sim/system/file.hpp"

namespace halfway {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

TEST(Machine, IsReadFromTheSystem) {
  const std::string text = machine();
  EXPECT_THAT(text, MatchesRegex("[1-9][0-9]* cores of [^,:]+, [1-9][0-9]* GiB"));
  const auto processors = read_file("/proc/cpuinfo");
  ASSERT_TRUE(processors);
  if (processors->find("model name") == std::string::npos) GTEST_SKIP() << "no processor is named here";
  const std::size_t from = text.find(" of ") + 4;
  EXPECT_THAT(*processors, HasSubstr("model name\t: " + text.substr(from, text.rfind(',') - from) + "\n"));
  const auto release = read_file("/etc/os-release");
  if (release && release->find("PRETTY_NAME=\"") != std::string::npos) {
    EXPECT_THAT(*release, HasSubstr("PRETTY_NAME=\"" + operating_system() + "\""));
  }
}

}  // namespace
}  // namespace halfway

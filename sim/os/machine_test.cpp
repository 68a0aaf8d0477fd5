// SPDX-License-Identifier: Apache-2.0
#include "sim/os/machine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

TEST(Machine, IsReadFromTheSystem) {
  const std::string text = machine();
  EXPECT_THAT(text, MatchesRegex("[1-9][0-9]* cores of [^,:]+(, AVX2|, AVX-512)?, [1-9][0-9]* GiB"));
  const auto processors = must(read_file("/proc/cpuinfo"));
  if (processors.find("model name") == std::string::npos) GTEST_SKIP() << "no processor is named here";
  const std::size_t from = text.find(" of ") + 4;
  EXPECT_THAT(processors, HasSubstr("model name\t: " + text.substr(from, text.find(',') - from) + "\n"));
  const auto release = read_file("/etc/os-release");
  if (release && release->find("PRETTY_NAME=\"") != std::string::npos) {
    EXPECT_THAT(*release, HasSubstr("PRETTY_NAME=\"" + operating_system() + "\""));
  }
}

#if defined(__x86_64__)
TEST(Machine, NamesTheWidestVectorsOfTheProcessor) {
  const std::string text = machine();
  const bool has_512 = __builtin_cpu_supports("avx512f") != 0, has_256 = __builtin_cpu_supports("avx2") != 0;
  EXPECT_EQ(text.find("AVX-512") != std::string::npos, has_512);
  EXPECT_EQ(text.find("AVX2") != std::string::npos, has_256 && !has_512);
}
#endif

}  // namespace
}  // namespace halfway

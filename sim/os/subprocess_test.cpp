// SPDX-License-Identifier: Apache-2.0
#include "sim/os/subprocess.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>

#include "common/test/is_error.hpp"
#include "sim/os/test/folder_test.hpp"

namespace halfway {
namespace {

Command shell(const std::string& script) {
  return {.arguments = {"sh", "-c", script}, .working_folder = {}};
}

ProcessEnd run(const Command& command) {
  return must(run_process(command, "apt-get install nothing"));
}

TEST(Subprocess, ReadsItsStandardInput) {
  int ends[2];
  ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
  ASSERT_EQ(::write(ends[1], "frames", 6), 6);
  ::close(ends[1]);
  Command command = shell("cat");
  command.standard_input = ends[0];
  EXPECT_EQ(run(command).output, "frames");
  EXPECT_EQ(::fcntl(ends[0], F_GETFD), -1) << "left open";
  EXPECT_EQ(run(shell("cat")).output, "");

  ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
  ::close(ends[1]);
  EXPECT_FALSE(run_process({.arguments = {"halfway-no-such-program"}, .standard_input = ends[0]}, ""));
  EXPECT_EQ(::fcntl(ends[0], F_GETFD), -1) << "left open";
}

TEST(Subprocess, EndsAllProcessesAtATimeout) {
  Command command = shell("sleep 100 & sleep 100; echo never");
  command.timeout = std::chrono::milliseconds(200);
  const auto start = std::chrono::steady_clock::now();
  const auto end = run(command);
  EXPECT_TRUE(end.timed_out);
  EXPECT_FALSE(end.succeeded());
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(Subprocess, DoesNotWaitForRemainingChildren) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(run(shell("sleep 100 & echo done")).succeeded());
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(Subprocess, KeepsStartAndEndOfLongOutput) {
  const auto end = run(shell("echo first; yes 0123456789 | head -n 300000; echo last"));
  EXPECT_EQ(end.output.substr(0, 6), "first\n");
  EXPECT_EQ(end.output.substr(end.output.size() - 5), "last\n");
  EXPECT_LT(end.output.size(), 200'000U);
}

using SubprocessInFolder = FolderTest;

TEST_F(SubprocessInFolder, HasAnEnvironmentAndAnOutputFile) {
  Command command = shell("echo $HALFWAY_TEST; pwd; echo err >&2");
  command.working_folder = here();
  command.environment = {{"HALFWAY_TEST", "a b"}};
  command.standard_output = at("out");
  EXPECT_EQ(run(command).output, "err\n");
  EXPECT_EQ(text_of("out"), "a b\n" + std::filesystem::canonical(here()).string() + "\n");
}

TEST(Subprocess, PrintsCommandsInShellSyntax) {
  EXPECT_EQ(to_string({.arguments = {"a-b", "c d", "it's", ""}, .working_folder = {}}),
            "a-b 'c d' 'it'\\''s' ''");
}

}  // namespace
}  // namespace halfway

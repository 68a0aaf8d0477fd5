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

TEST(Subprocess, ReturnsStatusAndOutput) {
  const auto end = run(shell("echo out; echo err >&2; exit 7"));
  EXPECT_EQ(end.exit_status, 7);
  EXPECT_FALSE(end.succeeded());
  EXPECT_EQ(end.output, "out\nerr\n");
  EXPECT_EQ(end.how(), "exit status 7");
  EXPECT_TRUE(run(shell("true")).succeeded());
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

TEST(Subprocess, ReportsTheSignal) {
  const auto end = run(shell("kill -SEGV $$"));
  EXPECT_EQ(end.signal, SIGSEGV);
  EXPECT_FALSE(end.succeeded());
  EXPECT_NE(end.how().find("signal 11"), std::string::npos);
}

TEST(Subprocess, ReportsAMissingProgram) {
  const auto end =
      run_process({.arguments = {"halfway-no-such-program"}, .working_folder = {}}, "apt-get install it");
  EXPECT_TRUE(is_error(end, ExitCode::tool_failed, "apt-get install it"));
}

TEST(Subprocess, ReportsAMissingFolder) {
  Command command = shell("true");
  command.working_folder = "/no/such/folder";
  EXPECT_TRUE(is_error(run_process(command, ""), ExitCode::tool_failed));
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

TEST(Subprocess, Polls) {
  int polls = 0;
  Command command = shell("sleep 0.5");
  command.poll_interval = std::chrono::milliseconds(50);
  command.on_poll = [&] { ++polls; };
  run(command);
  EXPECT_GE(polls, 3);
}

TEST(Subprocess, PrintsCommandsInShellSyntax) {
  EXPECT_EQ(to_string({.arguments = {"a-b", "c d", "it's", ""}, .working_folder = {}}),
            "a-b 'c d' 'it'\\''s' ''");
}

}  // namespace
}  // namespace halfway

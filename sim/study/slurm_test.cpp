// SPDX-License-Identifier: Apache-2.0
// Tests of a job array's script, and of the array run by a shell instead of Slurm. tb/project/slurm runs it
// in a real Slurm.
#include "sim/study/slurm.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "sim/os/subprocess.hpp"
#include "sim/os/test/folder_test.hpp"
#include "sim/study/stand_in_slurm_test.hpp"

namespace halfway::study {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class JobScriptTest : public FolderTest {
 protected:
  void SetUp() override { put_program(at("scontrol"), "#!/bin/sh\necho \"scontrol $*\"\n"); }
  ProcessEnd run(const JobArray& array, const std::string& restarts) const {
    return must(run_process({.arguments = {"sh", "-c", job_script(array)},
                             .environment = {{"PATH", here().string() + ":/usr/bin:/bin"},
                                             {"SLURM_ARRAY_TASK_ID", "3"},
                                             {"SLURM_ARRAY_JOB_ID", "77"},
                                             {"SLURM_RESTART_COUNT", restarts}}},
                            ""));
  }
};

TEST_F(JobScriptTest, PassesThePartToTheWorkerLiterally) {
  const ProcessEnd end = run({.worker = {"printf", "<%s>", "a b", "it's", "$HOME", "--"}, .parts = 8}, "0");
  EXPECT_TRUE(end.succeeded());
  EXPECT_EQ(end.output, "<a b><it's><$HOME><--><--part><3/8>");
}

TEST_F(JobScriptTest, RequeuesAFailedTaskAFewTimes) {
  const JobArray array{.worker = {"sh", "-c", "exit 5"}, .parts = 8};
  for (const char* restarts : {"", "0", "1"}) {
    const ProcessEnd end = run(array, restarts);
    EXPECT_THAT(end.output, HasSubstr("scontrol requeue 77_3")) << restarts;
    EXPECT_EQ(end.exit_status, 5);
  }
  const ProcessEnd end = run(array, "2");
  EXPECT_THAT(end.output, Not(HasSubstr("scontrol")));
  EXPECT_EQ(end.exit_status, 5);
}

class JobArrayTest : public FolderTest {
 protected:
  void SetUp() override {
    put_slurm(here());
    ::setenv("PATH", (here().string() + ":" + path_).c_str(), 1);
  }
  void TearDown() override { ::setenv("PATH", path_.c_str(), 1); }
  // Run tasks 1, 4 and 5 of 8. $2 is the part.
  JobArray array(const std::string& script) const {
    return {.worker = {"sh", "-c", script, "worker"}, .parts = 8, .open = {1, 4, 5}, .folder = at("slurm")};
  }
  const std::string path_ = std::getenv("PATH");
};

TEST_F(JobArrayTest, RunsTheOpenPartsAndReportsAFailedOneWithItsOutput) {
  const Status ran = caught([&] {
    run_job_array(array("echo part $2 >>'" + at("parts").string() +
                        "'; [ $2 != 5/8 ] || { echo 'no such scene' >&2; exit 2; }"));
  });
  const std::string parts = text_of("parts");
  for (const char* part : {"part 1/8\n", "part 4/8\n", "part 5/8\n"}) EXPECT_THAT(parts, HasSubstr(part));
  EXPECT_EQ(std::ranges::count(parts, '\n'), 2 + 3);  // the failed one three times
  ASSERT_FALSE(ran);
  EXPECT_EQ(ran.error().code, ExitCode::tool_failed);
  EXPECT_THAT(ran.error().message, AllOf(HasSubstr("sbatch: exit status 1"), HasSubstr("task-5.log:\n"),
                                         HasSubstr("no such scene"), Not(HasSubstr("task-4.log"))));
}

}  // namespace
}  // namespace halfway::study

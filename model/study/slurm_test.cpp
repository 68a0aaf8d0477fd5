// SPDX-License-Identifier: Apache-2.0
// The script of a job array, run by a shell in the place of Slurm. tb/slurm has a real one.
#include "study/slurm.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "common/file.hpp"
#include "common/subprocess.hpp"

namespace halfway::study {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class JobScriptTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto folder = TemporaryFolder::make(std::filesystem::temp_directory_path());
    ASSERT_TRUE(folder) << folder.error().message;
    folder_.emplace(std::move(*folder));
    ASSERT_TRUE(write_file(folder_->path() / "scontrol", "#!/bin/sh\necho \"scontrol $*\"\n"));
    std::filesystem::permissions(folder_->path() / "scontrol", std::filesystem::perms::owner_all);
  }
  ProcessEnd run(const JobArray& array, const std::string& restarts) const {
    const auto end = run_process({.arguments = {"sh", "-c", job_script(array)},
                                  .environment = {{"PATH", folder_->path().string() + ":/usr/bin:/bin"},
                                                  {"SLURM_ARRAY_TASK_ID", "3"},
                                                  {"SLURM_ARRAY_JOB_ID", "77"},
                                                  {"SLURM_RESTART_COUNT", restarts}}},
                                 "");
    EXPECT_TRUE(end);
    return end ? *end : ProcessEnd{};
  }
  std::optional<TemporaryFolder> folder_;
};

TEST_F(JobScriptTest, HandsThePartToTheWorkerWordForWord) {
  const ProcessEnd end = run({.worker = {"printf", "<%s>", "a b", "it's", "$HOME", "--"}, .parts = 8}, "0");
  EXPECT_TRUE(end.succeeded());
  EXPECT_EQ(end.output, "<a b><it's><$HOME><--><--part><3/8>");
}

TEST_F(JobScriptTest, HasSlurmTryAgainAFewTimes) {
  const JobArray array{.worker = {"sh", "-c", "exit 5"}, .parts = 8, .retries = 2};
  for (const char* restarts : {"", "0", "1"}) {
    const ProcessEnd end = run(array, restarts);
    EXPECT_THAT(end.output, HasSubstr("scontrol requeue 77_3")) << restarts;
    EXPECT_EQ(end.exit_status, 5);
  }
  const ProcessEnd end = run(array, "2");
  EXPECT_THAT(end.output, Not(HasSubstr("scontrol")));
  EXPECT_EQ(end.exit_status, 5);
}

}  // namespace
}  // namespace halfway::study

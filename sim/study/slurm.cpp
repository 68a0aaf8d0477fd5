// SPDX-License-Identifier: Apache-2.0
#include "sim/study/slurm.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/subprocess.hpp"

namespace halfway::study {
namespace {

constexpr const char* c_install = "apt-get install slurm-client, on a machine of the cluster";
constexpr std::size_t c_shown = 2000;  // characters of a task's output
constexpr unsigned c_retries = 2;      // of a failing task, by Slurm

std::filesystem::path task_log(const JobArray& array, std::size_t part) {
  return array.folder / fmt::format("task-{}.log", part);
}

}  // namespace

std::string job_script(const JobArray& array) {
  std::string command;
  for (const std::string& word : array.worker) command += shell_word(word) + " ";
  return fmt::format(
      "#!/bin/sh\n"
      "{}--part \"$SLURM_ARRAY_TASK_ID/{}\" && exit 0\n"
      "status=$?\n"
      "# The node may be at fault: Slurm finds another.\n"
      "if [ \"${{SLURM_RESTART_COUNT:-0}}\" -lt {} ]; then\n"
      "  echo \"exit status $status; tried again\"\n"
      "  scontrol requeue \"${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID\"\n"
      "fi\n"
      "exit $status\n",
      command, array.parts, c_retries);
}

void run_job_array(const JobArray& array) {
  if (array.open.empty()) return;
  for (const std::size_t part : array.open) {
    std::error_code ignored;
    std::filesystem::remove(task_log(array, part), ignored);
  }
  must(make_folders(array.folder));
  const std::filesystem::path script = array.folder / "job.sh";
  must(write_file(script, job_script(array)));
  Command submit{.arguments = {"sbatch", "--wait", "--requeue", "--job-name=halfway-study",
                               fmt::format("--array={}", fmt::join(array.open, ",")),
                               "--output=" + (array.folder / "task-%a.log").string(), "--open-mode=append"}};
  submit.arguments.insert(submit.arguments.end(), array.options.begin(), array.options.end());
  submit.arguments.push_back(script.string());
  const ProcessEnd end = must(run_process(submit, c_install));
  if (end.succeeded()) return;
  std::string what = fmt::format("sbatch: {}: {}", end.how(), end.output);
  for (const std::size_t part : array.open) {
    const auto said = read_file(task_log(array, part));
    if (!said || said->find("exit status ") == std::string::npos) continue;
    what += fmt::format("\n{}:\n{}", task_log(array, part).string(),
                        said->size() > c_shown ? said->substr(said->size() - c_shown) : *said);
    break;
  }
  throw_tool_failed("{}", what);
}

}  // namespace halfway::study

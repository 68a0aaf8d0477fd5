// SPDX-License-Identifier: Apache-2.0
// Parts of a study as tasks of a Slurm job array.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"

namespace halfway::study {

struct JobArray {
  /// What measures a part, without a shell: the program and its arguments, to which `--part I/N` is added. It
  /// must lie, as all that it names, where the nodes find it under the same path.
  std::vector<std::string> worker;
  std::size_t parts = 1;             ///< N
  std::vector<std::size_t> open;     ///< of these, those that are submitted
  std::filesystem::path folder;      ///< for the job's script and its tasks' output; the nodes must reach it
  unsigned retries = 2;              ///< of a task that fails, by Slurm
  std::vector<std::string> options;  ///< more of sbatch's, such as --partition=short
};

/// The batch script.
std::string job_script(const JobArray& array);

/// Submits the array and waits for its end. Where a task fails for good, an error with the end of what it
/// said.
Status run_job_array(const JobArray& array);

/// How a line of a worker's begins that whoever submitted the array is to be told, too.
inline constexpr std::string_view c_note = "note: ";
/// Such lines of all tasks that ran, however the array ended.
std::vector<std::string> notes_of(const JobArray& array);

}  // namespace halfway::study

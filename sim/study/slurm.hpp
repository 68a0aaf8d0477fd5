// SPDX-License-Identifier: Apache-2.0
// Run the parts of a study as tasks of a Slurm job array.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"

namespace halfway::study {

struct JobArray {
  /// Command that measures a part: program and arguments, run without a shell, with `--part I/N` appended.
  /// The nodes must see the program and all its files under the same paths.
  std::vector<std::string> worker;
  std::size_t parts = 1;          ///< N of --part
  std::vector<std::size_t> open;  ///< the parts to submit
  /// for the job's script and the output of its tasks; the nodes must be able to access it
  std::filesystem::path folder;
  unsigned retries = 2;              ///< of a failing task, by Slurm
  std::vector<std::string> options;  ///< additional options of sbatch, such as --partition=short
};

/// The batch script.
std::string job_script(const JobArray& array);

/// Submit the array and wait for its end. If a task fails finally, the error contains the end of its output.
Status run_job_array(const JobArray& array);

/// Prefix of the output lines of a worker that are passed on to the process that submitted the array.
inline constexpr std::string_view c_note = "note: ";
/// Such lines of all tasks that ran, also if the array failed.
std::vector<std::string> notes_of(const JobArray& array);

}  // namespace halfway::study

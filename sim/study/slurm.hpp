// SPDX-License-Identifier: Apache-2.0
// Run the parts of a study as tasks of a Slurm job array.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace halfway::study {

struct JobArray {
  /// Command that measures a part: program and arguments, run without a shell, with `--part I/N` appended.
  /// The nodes must see the program and all its files under the same paths.
  std::vector<std::string> worker;
  std::size_t parts = 1;          ///< N of --part
  std::vector<std::size_t> open;  ///< the parts to submit
  /// for the job's script and the output of its tasks; the nodes must be able to access it
  std::filesystem::path folder;
  std::vector<std::string> options;  ///< additional options of sbatch, such as --partition=short
};

/// The batch script.
std::string job_script(const JobArray& array);

/// Submit the array and wait for its end. If a task fails finally, throws Failure with the end of its output.
void run_job_array(const JobArray& array);

}  // namespace halfway::study

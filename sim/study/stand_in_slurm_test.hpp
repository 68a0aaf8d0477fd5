// SPDX-License-Identifier: Apache-2.0
// Replacement for Slurm: an `sbatch --wait` that runs the tasks one after the other on this machine and
// repeats a task that requests requeueing.
#pragma once

#include <filesystem>

#include "sim/os/test/folder_test.hpp"

namespace halfway::study {

inline constexpr const char* c_sbatch = R"(#!/bin/bash
for word; do
  case $word in
    --array=*) tasks=${word#*=} ;;
    --output=*) log=${word#*=} ;;
  esac
done
failed=0
for task in ${tasks//,/ }; do
  for restart in 0 1 2; do
    SLURM_ARRAY_TASK_ID=$task SLURM_ARRAY_JOB_ID=77 SLURM_RESTART_COUNT=$restart \
      sh "${!#}" >>"${log/\%a/$task}" 2>&1 && continue 2
  done
  failed=1
done
exit $failed
)";

inline void put_slurm(const std::filesystem::path& folder) {
  put_program(folder / "sbatch", c_sbatch);
  put_program(folder / "scontrol", "#!/bin/sh\n");
}

}  // namespace halfway::study

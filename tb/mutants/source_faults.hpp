// SPDX-License-Identifier: Apache-2.0
// Faults in the text of the sources and of the vector files. A testbench in GHDL must detect them.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace halfway::mutants {

struct SourceFault {
  std::string file;  ///< relative to the project's root, or to the folder of vectors
  std::string old_text, new_text;
  unsigned line = 0, word = 0;  ///< of a vector file; both 0: the file ends early
  bool in_vectors = false;
  std::string test;    ///< the entity whose testbench must fail
  bool quick = false;  ///< part of the quick form
};

// These functions throw Failure.

/// Reads source_faults.toml.
std::vector<SourceFault> read_source_faults(const std::filesystem::path& file);

/// The file's text with the fault. Fails if the old text does not occur exactly once, or if the vector file
/// does not have the word.
std::string with_fault(const SourceFault& fault, const std::string& text);

enum class TestEnd { passes, fails, unfinished };

/// Runs the testbench of `fault.test` in a copy of the sources and vectors. Without a file the copy has no
/// fault. A testbench whose analysis or run takes longer than `c_testbench_time` is unfinished.
TestEnd run_testbench(const SourceFault& fault, const std::filesystem::path& source,
                      const std::filesystem::path& vectors, const std::filesystem::path& scratch);
inline constexpr std::chrono::seconds c_testbench_time{900};

}  // namespace halfway::mutants

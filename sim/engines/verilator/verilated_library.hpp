// SPDX-License-Identifier: Apache-2.0
// Build a shared library from a netlist: Verilator, then one translation unit of its output and a harness.
// Libraries are cached.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "sim/os/shared_library.hpp"

namespace halfway {

struct VerilatedBuild {
  std::string name;     ///< prefix of the cached build's folder
  std::string netlist;  ///< after mend_netlist
  std::string top;
  std::filesystem::path harness;                       ///< a C++ source that includes "Vshader.h"
  std::filesystem::path include_folder;                ///< the project's root, for the harness's own includes
  std::vector<std::filesystem::path> harness_headers;  ///< headers that the harness depends on
  std::vector<std::string> definitions;                ///< NAME=value for the harness
  std::vector<std::string> verilator_flags;            ///< more of Verilator's
  bool waves = false;                                  ///< with FST tracing, which is slower
  bool fast = true;                                    ///< optimize, which takes long to compile
  std::string compiler;                                ///< empty: clang++ if installed, otherwise g++
};

/// Build the library in build/cache/verilator/<name>-<hash>/ unless it exists, and load it.
Result<SharedLibrary> open_verilated(const VerilatedBuild& build, const std::filesystem::path& cache);

}  // namespace halfway

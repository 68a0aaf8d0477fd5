// SPDX-License-Identifier: Apache-2.0
// From a netlist to a shared library: Verilator, then one translation unit of its output and a harness,
// cached.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "sim/system/shared_library.hpp"

namespace halfway {

struct VerilatedBuild {
  std::string name;     ///< of the cached build, before the hash
  std::string netlist;  ///< mended
  std::string top;
  std::filesystem::path harness;                       ///< a C++ source that includes "Vshader.h"
  std::filesystem::path include_folder;                ///< the project's root, for the harness's own includes
  std::vector<std::filesystem::path> harness_headers;  ///< which its meaning depends on
  std::vector<std::string> definitions;                ///< NAME=value for the harness
  bool waves = false;                                  ///< with FST tracing, which costs speed
  bool fast = true;                                    ///< worth a long compilation
  std::string compiler;                                ///< empty: clang++ where it is installed, else g++
};

/// Builds the library in build/cache/verilator/<name>-<hash>/ unless it is there, and loads it.
Result<SharedLibrary> open_verilated(const VerilatedBuild& build, const std::filesystem::path& cache);

}  // namespace halfway

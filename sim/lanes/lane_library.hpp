// SPDX-License-Identifier: Apache-2.0
// From a netlist to a shared library of lanes: Verilator's XML, the generated C++ and a harness, cached.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "sim/lanes/lane_generator.hpp"
#include "sim/system/shared_library.hpp"

namespace halfway {

struct LaneBuild {
  std::string name;     ///< of the cached build, before the hash
  std::string netlist;  ///< mended
  std::string top;
  LanePorts ports;
  std::filesystem::path harness;         ///< a C++ source that includes "lanes.hpp"
  std::filesystem::path source;          ///< the project's root
  std::vector<std::string> definitions;  ///< NAME=value for the harness
  bool fast = true;                      ///< worth a long compilation
  std::string compiler;                  ///< empty: clang++ where it is installed, else g++
};

/// Builds the library in build/cache/lanes/<name>-<hash>/ unless it is there, and loads it.
Result<SharedLibrary> open_lanes(const LaneBuild& build, const std::filesystem::path& cache);

}  // namespace halfway

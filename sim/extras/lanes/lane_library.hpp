// SPDX-License-Identifier: Apache-2.0
// From a netlist to compiled lanes: Verilator's XML, the generated C++ and a harness, cached.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/extras/lanes/lane_generator.hpp"
#include "sim/extras/lanes/register_names.hpp"
#include "sim/os/shared_library.hpp"

namespace halfway {

/// The widest vectors that a library may use, with 16, 8 or 4 lanes; the processor's, if it has none as wide.
/// `none`: 4 lanes without vector instructions.
enum class LaneVectors { avx512, avx2, sse, none };

enum class LaneTarget {
  processor,    ///< a shared library for this machine
  web_assembly  ///< a module for browsers: wasm32 with vectors of 128 bits, 4 lanes
};

struct LaneBuild {
  std::string name;     ///< prefix of the cached build's folder
  std::string netlist;  ///< after mend_netlist
  std::string top;
  LanePorts ports;
  std::filesystem::path harness;         ///< a C++ source that includes "lanes.hpp"
  std::filesystem::path source;          ///< the project's root
  std::vector<std::string> definitions;  ///< NAME=value for the harness
  bool fast = true;                      ///< optimize, which takes long to compile
  LaneVectors vectors = LaneVectors::avx512;
  LaneTarget target = LaneTarget::processor;
  RegisterNames names{};  ///< without: the netlist's
};

/// Generate and compile in build/cache/lanes/<name>-<hash>/ unless it exists. The compiled file, lanes.so or
/// lanes.wasm, next to the generated text, lanes.hpp. Throws Failure.
std::filesystem::path build_lanes(const LaneBuild& build, const std::filesystem::path& cache);

}  // namespace halfway

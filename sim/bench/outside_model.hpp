// SPDX-License-Identifier: Apache-2.0
// What others would simulate the RTL by, for `make bench` to measure the project's own way against: programs
// made of the same netlist by Verilator and by CXXRTL as they come.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "common/result.hpp"
#include "frame/fragment.hpp"
#include "plan/hardware_key.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway {

enum class OutsideTool {
  verilator,  ///< `verilator --cc --exe --build`: its own flags for itself, make and g++
  cxxrtl,     ///< Yosys' write_cxxrtl with its own flags, compiled by clang++, else g++, with -O3
};
inline const char* to_string(OutsideTool tool) {
  return tool == OutsideTool::verilator ? "Verilator as it comes" : "CXXRTL";
}

struct OutsideRun {
  std::vector<Fragment> fragments;
  double seconds = 0.0;      ///< of the processor, for the clocks alone
  std::uint64_t cycles = 0;  ///< from the first vector offered to idle hardware
};

class OutsideModel {
 public:
  /// Builds the program in build/cache/bench/, or takes it from there. Without `fast` the C++ is compiled
  /// without optimization where the tool leaves that to us: to compare, not to measure.
  static Result<OutsideModel> open(OutsideTool tool, const HardwareKey& key, const SimulatorFolders& folders,
                                   bool fast = true);

  /// A process that draws all vectors at full speed.
  Result<OutsideRun> run(std::span<const std::uint32_t> init_words) const;

 private:
  OutsideModel(std::filesystem::path program, std::filesystem::path scratch)
      : program_(std::move(program)), scratch_(std::move(scratch)) {}
  std::filesystem::path program_, scratch_;
};

}  // namespace halfway

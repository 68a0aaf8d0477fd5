// SPDX-License-Identifier: Apache-2.0
// Simulators of the RTL as standard tools make them: programs that Verilator and CXXRTL build from the same
// netlist. `make bench` compares them with the project's own simulator.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "frame/fragment.hpp"
#include "plan/hardware_key.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway {

enum class OutsideTool {
  verilator,  ///< `verilator --cc --exe --build`: Verilator's default flags, make and g++
  cxxrtl,     ///< Yosys's write_cxxrtl with its default flags, compiled by clang++ (otherwise g++) with -O3
};

struct OutsideRun {
  std::vector<Fragment> fragments;
  double seconds = 0.0;  ///< processor seconds of the clock loop only
};

/// Its functions throw Failure.
class OutsideModel {
 public:
  /// Build the program in build/cache/bench/, or use the cached one. Without `fast`, the C++ is compiled
  /// without optimization if the tool allows it; this suffices for comparing pictures, but not for timing.
  OutsideModel(OutsideTool tool, const HardwareKey& key, const SimulatorFolders& folders, bool fast = true);

  /// Run a process that draws all vectors at full speed.
  OutsideRun run(std::span<const std::uint32_t> init_words) const;

 private:
  std::filesystem::path program_, scratch_;
};

}  // namespace halfway

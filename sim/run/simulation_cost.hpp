// SPDX-License-Identifier: Apache-2.0
// Cost of a scene on given hardware: cycles, and the simulators' time.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "frame/frame.hpp"
#include "plan/hardware_key.hpp"
#include "scene/scene.hpp"
#include "setup/setup.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway {

struct CostSettings {
  FrameSize size;
  SetupOptions setup{};
  unsigned threads = 1;
  bool ghdl = true, verilator = true;
  SimulatorFolders folders;
  /// Called with a description of each step.
  std::function<void(const std::string& what)> on_progress = [](const std::string&) {};
};

struct SimulationCost {
  std::uint64_t fragments = 0, cycles = 0;
  /// Processor seconds of the simulation only, the minimum of up to three runs. std::nullopt: not run.
  std::optional<double> ghdl_seconds, verilator_seconds;
  Frame frame;  ///< drawn by Verilator, or without it by the golden model
};

/// Throws Failure on a hang or another failure of the hardware. The picture is not compared with the golden
/// model's.
SimulationCost simulation_cost(const Scene& scene, const HardwareKey& key, const CostSettings& settings);

}  // namespace halfway

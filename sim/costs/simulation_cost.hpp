// SPDX-License-Identifier: Apache-2.0
// What a scene costs on given hardware: cycles, and the simulators' time.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "common/result.hpp"
#include "frame/frame.hpp"
#include "plan/hardware_key.hpp"
#include "scene/scene.hpp"
#include "setup/setup.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway {

struct CostSettings {
  FrameSize size;
  SetupOptions setup;
  unsigned threads = 1;
  bool ghdl = true, verilator = true;
  SimulatorFolders folders;
  /// Told what is being done.
  std::function<void(const std::string& what)> on_progress = [](const std::string&) {};
};

struct SimulationCost {
  std::uint64_t fragments = 0, cycles = 0;
  /// Processor seconds of the simulation alone, the least of up to three. None: not run.
  std::optional<double> ghdl_seconds, verilator_seconds;
  Frame frame;  ///< Verilator's, or without it the golden model's
};

/// Hardware that hangs or the like is an error; whether it draws what the golden model draws is not looked
/// at.
Result<SimulationCost> simulation_cost(const Scene& scene, const HardwareKey& key,
                                       const CostSettings& settings);

}  // namespace halfway

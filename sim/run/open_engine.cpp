// SPDX-License-Identifier: Apache-2.0
#include "sim/run/open_engine.hpp"

#include "sim/driver/limits.hpp"
#include "sim/engines/ghdl/ghdl_engine.hpp"
#include "sim/engines/verilator/verilator_simulator.hpp"

namespace halfway {

Result<std::shared_ptr<Engine>> open_engine(EngineKind kind, const HardwareKey& key,
                                            const SimulatorFolders& folders, const EngineOptions& options) {
  switch (kind) {
    case EngineKind::ghdl:
      return shared_engine(GhdlEngine::open(key, folders, options.threads,
                                            {.idle_limit = idle_limit(key),
                                             .stall_seed = options.stall_seed,
                                             .on_progress = options.on_progress}));
    case EngineKind::verilator:
      return shared_engine(VerilatorSimulator::open(
          key, folders, {.stall_seed = options.stall_seed, .idle_limit = idle_limit(key)}));
    case EngineKind::lanes:
      break;
  }
  return open_lanes(key, folders, options);
}

}  // namespace halfway

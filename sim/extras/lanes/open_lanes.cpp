// SPDX-License-Identifier: Apache-2.0
#include "sim/driver/limits.hpp"
#include "sim/extras/lanes/lane_simulator.hpp"
#include "sim/run/open_engine.hpp"

namespace halfway {

Result<std::shared_ptr<Engine>> open_lanes(const HardwareKey& key, const SimulatorFolders& folders,
                                           const EngineOptions& options) {
  return shared_engine(LaneSimulator::open(
      key, folders,
      {.threads = options.threads, .idle_limit = c_idle_limit, .stall_seed = options.stall_seed}));
}

}  // namespace halfway

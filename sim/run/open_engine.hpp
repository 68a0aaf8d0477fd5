// SPDX-License-Identifier: Apache-2.0
// Opens an engine by its kind, and decides when lanes save time.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "common/result.hpp"
#include "plan/hardware_key.hpp"
#include "sim/driver/engine.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway {

struct EngineOptions {
  unsigned threads = 1;          ///< for engines that use several
  std::uint32_t stall_seed = 0;  ///< not 0: both streams stall at random
  /// Called by engines that draw late, with the number of bytes of trace written so far.
  std::function<void(std::uintmax_t trace_bytes)> on_progress{};
};

/// Builds the engine, or takes it from the cache.
Result<std::shared_ptr<Engine>> open_engine(EngineKind kind, const HardwareKey& key,
                                            const SimulatorFolders& folders,
                                            const EngineOptions& options = {});

/// The same for lanes. Defined in sim/extras/lanes; a program without extras returns an error.
Result<std::shared_ptr<Engine>> open_lanes(const HardwareKey& key, const SimulatorFolders& folders,
                                           const EngineOptions& options);

/// Pixels of all frames from which on lanes save more than the seconds of their compilation.
inline constexpr double c_least_lane_pixels = double(1U << 26);

}  // namespace halfway

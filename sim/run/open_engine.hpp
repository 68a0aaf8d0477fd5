// SPDX-License-Identifier: Apache-2.0
// Opens an engine by its kind; and when lanes pay.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

#include "common/result.hpp"
#include "plan/hardware_key.hpp"
#include "sim/engine/engine.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway {

struct EngineOptions {
  unsigned threads = 1;          ///< of engines that can use several
  std::uint32_t stall_seed = 0;  ///< not 0: both streams stall at random
  bool fast = true;              ///< worth a long compilation
  /// Of engines that draw late: told how many bytes of trace there are.
  std::function<void(std::uintmax_t trace_bytes)> on_progress{};
};

/// Builds the engine, or takes it from the cache. What the key's hardware cannot be drawn by is bad input.
Result<std::shared_ptr<Engine>> open_engine(EngineKind kind, const HardwareKey& key,
                                            const SimulatorFolders& folders,
                                            const EngineOptions& options = {});

/// Of all frames together; from here on lanes save more than the 5 s that their compilation takes.
inline constexpr double c_least_lane_pixels = double(1U << 26);

/// Whether to draw so many pixels in lanes rather than in Verilator: on processors with AVX-512, a shader
/// whose triangles stand alone, and work enough.
bool lanes_pay(const HardwareKey& key, double pixels);

}  // namespace halfway

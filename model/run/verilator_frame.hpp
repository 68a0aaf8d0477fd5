// SPDX-License-Identifier: Apache-2.0
// One frame by the RTL in Verilator, for who wants it right or not at all.
#pragma once

#include <cstdint>
#include <vector>

#include "common/result.hpp"
#include "frame/frame.hpp"
#include "plan/hardware_key.hpp"
#include "scene/scene.hpp"
#include "setup/setup.hpp"
#include "sim/verilator/verilator_simulator.hpp"

namespace halfway {

struct VerilatorFrame {
  Frame frame;
  std::vector<std::uint8_t> mask;  ///< a byte a pixel: 1 where a fragment covers it
  std::uint64_t fragments = 0, cycles = 0;
  SetupCounts counts;
};

/// Every fragment is compared with the golden model's: one that differs, or a fault of the hardware, is an
/// error (ExitCode::differs) that tells the first ones.
Result<VerilatorFrame> draw_in_verilator(const Scene& scene, FrameSize size, const HardwareKey& key,
                                         const SetupOptions& options, const SimulatorFolders& folders,
                                         unsigned threads);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// One correct frame drawn by the RTL in Verilator.
#pragma once

#include <cstdint>
#include <vector>

#include "frame/frame.hpp"
#include "plan/hardware_key.hpp"
#include "scene/scene.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway {

struct VerilatorFrame {
  Frame frame;                     ///< the frame or a tile of it
  std::vector<std::uint8_t> mask;  ///< one byte per pixel: 1 if a fragment covers it
  std::uint64_t fragments = 0;     ///< of the frame or tile
  std::uint64_t cycles = 0;        ///< includes the cycles for pixels outside the tile
  SetupCounts counts;              ///< the sum over the tiles of a frame equals the frame's counts
};

/// Compares every fragment with the golden model's. Throws Failure with the first differences
/// (ExitCode::differs) on a difference or a fault of the hardware.
VerilatorFrame draw_in_verilator(const Scene& scene, FrameSize size, const HardwareKey& key,
                                 const SimulatorFolders& folders, FrameOptions options);

}  // namespace halfway

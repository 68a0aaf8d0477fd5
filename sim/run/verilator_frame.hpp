// SPDX-License-Identifier: Apache-2.0
// One frame by the RTL in Verilator, for who wants it right or not at all.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/result.hpp"
#include "frame/frame.hpp"
#include "frame/tile.hpp"
#include "plan/hardware_key.hpp"
#include "scene/scene.hpp"
#include "setup/setup.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway {

class MadeFormats;

struct VerilatorFrame {
  Frame frame;                     ///< or a tile of it
  std::vector<std::uint8_t> mask;  ///< a byte a pixel: 1 where a fragment covers it
  std::uint64_t fragments = 0;     ///< of the frame or tile
  std::uint64_t cycles = 0;        ///< with those in which pixels beside the tile are drawn
  SetupCounts counts;              ///< the tiles' of a frame together are the frame's
};

/// Every fragment is compared with the golden model's: one that differs, or a fault of the hardware, is an
/// error (ExitCode::differs) that tells the first ones. Of a tile's pixels every fragment is the whole
/// frame's. `formats` makes setup and golden model of a key with other word lengths; null: the program's own.
Result<VerilatorFrame> draw_in_verilator(const Scene& scene, FrameSize size, const HardwareKey& key,
                                         const SetupOptions& options, const SimulatorFolders& folders,
                                         unsigned threads, const std::optional<Tile>& tile = {},
                                         const MadeFormats* formats = nullptr);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// One point of a study: how far its picture is from the reference, and what it takes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "frame/frame.hpp"
#include "frame/metrics.hpp"
#include "setup/setup.hpp"
#include "sim/ghdl/ghdl_library.hpp"
#include "sim/study/design_point.hpp"
#include "sim/study/mach_bands.hpp"
#include "sim/study/pictures.hpp"

namespace halfway::study {

/// What a point's design draws, and takes for it: a frame, or a tile of one.
struct Drawing {
  Frame frame;
  std::vector<std::uint8_t> mask;  ///< of pixels that it covers; empty in software: as the reference
  std::string hardware;            ///< the key's name; empty in software
  std::uint64_t fragments = 0;     ///< 0 in software
  std::uint64_t cycles = 0;        ///< of the RTL
  SetupCounts setup;               ///< host
};

struct Measurement {
  Frame frame;              ///< of the RTL, where it is hardware's
  FrameDistance picture;    ///< against the reference, over the pixels that either covers
  FrameDistance highlight;  ///< over those of Reference::highlight
  std::uint64_t perceived =
      0;  ///< pixels whose difference is seen (Yee, at 100 cd/m2 and 45 degrees of view)
  MachBands mach_bands;
  std::uint64_t triangles = 0;  ///< of the scene
  std::uint64_t fragments = 0;  ///< 0 in software
  std::string hardware;         ///< the key's name; empty in software
  std::uint64_t cycles = 0;     ///< of the RTL, for the frame; in tiles: for all of them
  SetupCounts setup;            ///< host
  /// Of the host, for the frame's init vectors; none in software, and where nothing counted them.
  std::optional<std::uint64_t> host_instructions;
};

/// Draws the frame, or a tile of it. Of hardware it is the RTL that draws, in Verilator; where a fragment
/// differs from the golden model's, that is an error with the exit code `differs`. The point must be drawn
/// (is_drawn).
Result<Drawing> draw(const DesignPoint& point, const Subject& subject, const SimulatorFolders& folders,
                     const std::optional<Tile>& tile = {});

/// The drawing of the whole frame against the reference; none: it is the reference.
Result<Measurement> measure(const Pictures& pictures, std::optional<Drawing> drawing);

}  // namespace halfway::study

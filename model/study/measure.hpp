// SPDX-License-Identifier: Apache-2.0
// One point of a study: how far its picture is from the reference, and what it takes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/result.hpp"
#include "frame/frame.hpp"
#include "frame/metrics.hpp"
#include "setup/setup.hpp"
#include "sim/ghdl/ghdl_library.hpp"
#include "study/design_point.hpp"
#include "study/mach_bands.hpp"
#include "study/pictures.hpp"

namespace halfway::study {

struct Measurement {
  Frame frame;              ///< of the RTL, where it is hardware's
  FrameDistance picture;    ///< against the reference, over the pixels that either covers
  FrameDistance highlight;  ///< over those of Pictures::highlight
  std::uint64_t perceived =
      0;  ///< pixels whose difference is seen (Yee, at 100 cd/m2 and 45 degrees of view)
  MachBands mach_bands;
  std::uint64_t triangles = 0;  ///< of the scene
  std::uint64_t fragments = 0;  ///< 0 in software
  std::string hardware;         ///< the key's name; empty in software
  std::uint64_t cycles = 0;     ///< of the RTL, for the frame
  SetupCounts setup;            ///< host
  /// Of the host, for the frame's init vectors; none in software, and where nothing counted them.
  std::optional<std::uint64_t> host_instructions;
};

/// Draws the point and measures it. Of hardware it is the RTL that draws, in Verilator; where a fragment
/// differs from the golden model's, that is an error with the exit code `differs`.
Result<Measurement> measure(const DesignPoint& point, const Pictures& pictures,
                            const SimulatorFolders& folders);

}  // namespace halfway::study

// SPDX-License-Identifier: Apache-2.0
// Measurement of one point of a study: the difference of its picture from the reference, and its cost.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "frame/metrics.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/engines/mesa/mesa_picture.hpp"
#include "sim/run/verilator_frame.hpp"
#include "sim/study/design_point.hpp"
#include "sim/study/mach_bands.hpp"
#include "sim/study/pictures.hpp"

namespace halfway::study {

/// The picture of a point's design and its cost, for a frame or a tile. In software, fragments, cycles and
/// counts are 0, and an empty mask stands for the reference's.
struct Drawing : VerilatorFrame {
  std::string hardware;  ///< the key's name; empty in software
};

/// The host's work for a frame, in time of one core of the machine that measured it.
struct HostTime {
  double ns = 0;
  std::uint64_t words = 0;  ///< 32-bit words sent to the hardware; 0 in software
};

/// The drawing of the whole frame, without its mask. With tiles, its figures are their sums.
struct Measurement : Drawing {
  FrameDistance picture;        ///< compared with the reference, over the pixels that either covers
  FrameDistance highlight;      ///< over the pixels of Reference::highlight
  std::uint64_t perceived = 0;  ///< pixels with a visible difference (FLIP)
  MachBands mach_bands;
  std::uint64_t triangles = 0;  ///< of the scene
  /// Host instructions for the frame's init vectors; std::nullopt in software, or if not counted.
  std::optional<std::uint64_t> host_instructions;
  /// Not a column of the study's table, because it varies from run to run.
  std::optional<HostTime> host_time{};
};

/// The picture of phong-mesa.
MesaRequest mesa_request(const DesignPoint& point, const std::string& scene);

/// Draw the frame or a tile. Hardware is drawn by the RTL in Verilator. If a fragment differs from the golden
/// model's, throws Failure with the exit code `differs`. The point must be drawn (is_drawn).
Drawing draw(const DesignPoint& point, const Subject& subject, const SimulatorFolders& folders,
             const std::optional<Tile>& tile = {});

/// Compare the drawing of the whole frame with the reference. Without a drawing, the reference is compared
/// with itself.
Measurement measure(const Pictures& pictures, std::optional<Drawing> drawing);

}  // namespace halfway::study

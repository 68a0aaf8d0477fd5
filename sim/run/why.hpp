// SPDX-License-Identifier: Apache-2.0
// The stages of one pixel in the hardware, in golden model and RTL, and their first difference. Verilator
// compares the whole frame fragment by fragment. GHDL simulates only the triangles that cover the pixel and
// the one with the first fragment that differs; its trace contains the registers of every stage.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plan/hardware_key.hpp"
#include "scene/scene.hpp"
#include "sim/driver/pixel_way.hpp"
#include "sim/driver/stream_comparator.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/run/draw_knobs.hpp"

namespace halfway {

struct WhySettings : DrawRequest {
  FramePixel pixel{0, 0};
  SimulatorFolders folders{};
  std::function<void(double done)> on_progress = [](double) {};
};

struct WhyReport {
  HardwareKey key;
  std::vector<PixelStory> stories;  ///< in drawing order; empty if no triangle covers the pixel
  std::optional<FirstDifference> first;
  std::optional<Mismatch> frame_difference;  ///< the first fragment of the frame that differs in Verilator
  std::string fault;                         ///< for example a hang; empty: none
  std::uint64_t fragments = 0;               ///< golden, in the frame
  std::uint64_t in_view = 0;                 ///< triangles
};

WhyReport explain_pixel(const Scene& scene, const WhySettings& settings);

}  // namespace halfway

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

#include "common/result.hpp"
#include "plan/hardware_key.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "setup/setup.hpp"
#include "sim/compare/stream_comparator.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway {

struct WhySettings {
  PlanRequest plan;
  FrameSize size;
  SetupOptions setup;
  unsigned threads = 1;
  std::uint32_t x = 0, y = 0;
  SimulatorFolders folders;
  std::function<void(double done)> on_progress = [](double) {};
};

/// A register or port in golden model and RTL.
struct StageValue {
  std::string name;
  std::uint64_t golden = 0;
  std::optional<std::uint64_t> rtl;  ///< std::nullopt if a bit is neither 0 nor 1
  int bits = 0, fraction_bits = 0;
  bool is_signed = false;
};

/// The values of a stage for the pixel.
struct StageState {
  std::string stage;                   ///< "line", "span", spherical: "sample", "product"; "fragment"
  std::optional<std::uint64_t> cycle;  ///< of GHDL's run; std::nullopt if the RTL has no such event
  std::vector<StageValue> values;
};

/// One triangle's fragment at the pixel.
struct PixelStory {
  std::uint64_t vector;  ///< number of the init vector in the stream
  std::uint32_t triangle;
  std::vector<StageValue> init;    ///< golden == rtl: both have the same input
  std::vector<StageValue> record;  ///< of the pixel's line; empty without line records
  std::vector<StageState> stages;
};

/// The first difference between RTL and golden model in GHDL's run.
struct FirstDifference {
  std::string stage, entity, value;
  std::uint64_t cycle;
  std::uint32_t triangle, y, x;
  std::string golden, rtl;
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

Result<WhyReport> explain_pixel(const Scene& scene, const WhySettings& settings);

}  // namespace halfway

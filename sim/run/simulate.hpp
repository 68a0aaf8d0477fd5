// SPDX-License-Identifier: Apache-2.0
// The main job: draws a scene by golden model, simulators and reference renderer, compares the streams, and
// writes frames and summary.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "frame/metrics.hpp"
#include "sim/driver/engine.hpp"
#include "sim/driver/rtl_frame.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/engines/ghdl/hardware_units.hpp"
#include "sim/run/draw_knobs.hpp"
#include "sim/run/result_files.hpp"

namespace halfway {

struct SimulateSettings : DrawRequest {
  std::vector<EngineKind> engines{EngineKind::ghdl, EngineKind::verilator};  ///< in the order of EngineKind
  std::uint32_t stall_seed = 0;  ///< not 0: both streams stall at random
  std::filesystem::path out{};
  SimulatorFolders folders{};
  /// Called with the current step and its progress: 0 to 1, or below 0 if unknown.
  std::function<void(const std::string& what, double done)> on_progress = [](const std::string&, double) {};
  /// Called with the folder of results if another run has locked it.
  std::function<void(const std::filesystem::path& folder)> on_wait = [](const std::filesystem::path&) {};
};

struct SceneSummary {
  std::string scene, shader;
  bool all_effects = false;  ///< elaborated, even if the scene does not need them
  Plan plan;
  UnitCounts units;  ///< entities that are elaborated
  FrameSize size;
  SetupCounts setup;
  std::uint64_t triangles = 0;  ///< of the scene
  std::uint64_t fragments = 0;  ///< golden
  std::vector<SimulatorRun> runs;
  FrameDistance accuracy;          ///< golden frame and reference, over the pixels that either covers
  std::vector<std::string> notes;  ///< of the scene, and remarks for a reader of the figures
  double setup_seconds = 0.0, golden_seconds = 0.0, seconds = 0.0;
  bool equal() const;
  /// std::nullopt if some fragment was compared, or if the scene has none and the reference agrees. Otherwise
  /// the reason, and what to change.
  std::optional<std::string> nothing_compared() const;
};

/// Triangles that are neither back-facing nor outside the view: on the screen, or too small for it.
inline std::uint64_t triangles_in_view(const SetupCounts& counts) {
  return counts.triangles + counts.projection.degenerate;
}
/// The same for stored results: fragments compared, triangles in view, pixels that the reference covers.
std::optional<std::string> nothing_compared(std::uint64_t fragments, std::uint64_t in_view,
                                            std::uint64_t reference_pixels);

/// Removes the summary of an earlier run: it says that the results are complete, but those of a scene that
/// this run has not drawn yet are old. Waits while another run has locked the folder.
void forget_summary(const ResultFiles& files, const std::function<void()>& on_wait);

/// Results are in ResultFiles::of(out, scene, plan). A difference in the hardware is not an error: see
/// SceneSummary::equal.
SceneSummary simulate(const Scene& scene, const SimulateSettings& settings);

/// The text of summary.json.
std::string to_json(const SceneSummary& summary);

/// One line: triangles, fragments, cycles, cycles per fragment, mismatches, PSNR, largest error, seconds.
std::string to_line(const SceneSummary& summary);

}  // namespace halfway

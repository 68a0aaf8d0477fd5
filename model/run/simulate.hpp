// SPDX-License-Identifier: Apache-2.0
// The main job: a scene through golden model, simulators and reference renderer; streams compared, frames and
// summary written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "frame/metrics.hpp"
#include "plan/plan.hpp"
#include "run/result_files.hpp"
#include "run/stream_comparator.hpp"
#include "setup/setup.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway {

struct SimulateSettings {
  PlanRequest plan;
  FrameSize size;
  SetupOptions setup;
  unsigned threads = 1;
  bool ghdl = true, verilator = true;
  std::uint32_t stall_seed = 0;  ///< not 0: both streams stall at random
  std::filesystem::path out;
  SimulatorFolders folders;
  /// Told what is being done, and how far it is (0 to 1, or below 0 where that is not known).
  std::function<void(const std::string& what, double done)> on_progress = [](const std::string&, double) {};
  /// Told the folder of results where another run holds it.
  std::function<void(const std::filesystem::path& folder)> on_wait = [](const std::filesystem::path&) {};
};

struct SimulatorRun {
  std::string simulator;
  std::uint64_t fragments = 0, mismatches = 0;
  /// Of the whole run; none where a fault ended it before its simulator could say.
  std::optional<std::uint64_t> cycles;
  std::uint64_t parts = 1;  ///< each from the reset on: some cycles more than in one
  std::optional<double> seconds;
  std::string fault;        ///< of the hardware, as the simulator tells it; empty: none
  std::string description;  ///< the first mismatches and their counts; empty: none
  std::vector<Mismatch> first;
  std::vector<std::filesystem::path> evidence;  ///< difference image, waveform
  bool equal() const { return mismatches == 0 && fault.empty(); }
};

struct SceneSummary {
  std::string scene, shader;
  bool all_effects = false;  ///< elaborated, whatever the scene calls for
  Plan plan;
  FrameSize size;
  SetupCounts setup;
  std::uint64_t triangles = 0;  ///< of the scene
  std::uint64_t fragments = 0;  ///< golden
  std::vector<SimulatorRun> runs;
  FrameDistance accuracy;          ///< golden frame against the reference, over the pixels that either covers
  std::vector<std::string> notes;  ///< what a reader of the figures should know
  double setup_seconds = 0.0, golden_seconds = 0.0, seconds = 0.0;
  bool equal() const;
};

/// Removes the summary that an earlier run left, which says that its results are whole: of a scene that is
/// yet to be drawn they must not pass for this run's. Waits while another run holds the folder.
Status forget_summary(const ResultFiles& files, const std::function<void()>& on_wait);

/// Results lie in ResultFiles::of(out, scene, shader, all_effects). Hardware that differs is no error: see
/// SceneSummary::equal.
Result<SceneSummary> simulate(const Scene& scene, const SimulateSettings& settings);

/// summary.json.
std::string to_json(const SceneSummary& summary);

/// One line: triangles, fragments, cycles, cycles a fragment, mismatches, PSNR, largest error, seconds.
std::string to_line(const SceneSummary& summary);

}  // namespace halfway

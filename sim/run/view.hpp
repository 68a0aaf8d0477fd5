// SPDX-License-Identifier: Apache-2.0
// A turntable: one scene from all sides, by one piece of hardware.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "frame/frame.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "setup/setup.hpp"
#include "sim/engine/engine.hpp"
#include "sim/ghdl/ghdl_library.hpp"
#include "sim/run/rtl_frame.hpp"

namespace halfway {

inline constexpr std::uint32_t c_most_view_frames = 10'000;

struct ViewSettings {
  PlanRequest plan;
  FrameSize size;
  SetupOptions setup;
  unsigned threads = 1;
  std::uint32_t frames = 36;         ///< of one turn; 1 to c_most_view_frames
  bool compare = true;               ///< else the golden model does not draw
  std::optional<EngineKind> engine;  ///< none: lanes where they pay and can be had, else Verilator
  SimulatorFolders folders;
  /// Told the key before its hardware is built, and for what.
  std::function<void(const std::string& key, EngineKind engine)> on_build = [](const std::string&,
                                                                               EngineKind) {};
  /// Called once the hardware is there, before anything is drawn.
  std::function<Status()> on_ready = []() -> Status { return Ok{}; };
  /// Called with each frame once it is drawn: by several threads at once, in no order.
  std::function<Status(std::uint32_t number, const Frame& frame)> on_drawn =
      [](std::uint32_t, const Frame&) -> Status { return Ok{}; };
  /// Called with each frame in their order, one at a time, after on_drawn.
  std::function<Status(std::uint32_t number, const Frame& frame)> on_next =
      [](std::uint32_t, const Frame&) -> Status { return Ok{}; };
};

/// Processor seconds of all frames.
struct ViewSeconds {
  double setup = 0.0, golden = 0.0, rtl = 0.0, compare = 0.0, assemble = 0.0;
  double images = 0.0;  ///< on_drawn
  ViewSeconds& operator+=(const ViewSeconds& other);
};

/// The first frame whose stream differs from the golden model's, or whose hardware went wrong.
struct ViewDifference {
  std::uint32_t frame;
  Camera camera;
  SimulatorRun run;
};

struct ViewSummary {
  std::string scene;
  Plan plan;
  FrameSize size;
  std::uint64_t triangles = 0;  ///< of the scene
  std::uint32_t frames = 0;     ///< drawn; all, unless one differs
  std::uint64_t fragments = 0;  ///< of the RTL, in all frames
  bool compared = true;
  std::uint64_t in_view = 0;                  ///< triangles, the most in a frame
  std::uint64_t reference_pixels = 0;         ///< in frames without a fragment, the most in one
  EngineKind engine = EngineKind::verilator;  ///< which drew
  std::vector<std::uint32_t> drawn_again;     ///< frames that Verilator drew after it
  unsigned threads = 1;
  double seconds = 0.0;  ///< from when the hardware was there until the last frame was taken
  ViewSeconds parts;
  std::optional<ViewDifference> difference;
  std::vector<std::string> notes;  ///< what a reader of the figures should know
  /// As SceneSummary::nothing_compared, of all frames; none where nothing was to be compared.
  std::optional<std::string> nothing_compared() const;
  double rate() const { return seconds > 0.0 ? frames / seconds : 0.0; }
};

/// Draws the scene from `frames` places around its camera's target. Hardware is planned and built once: no
/// effect depends on the camera. Threads draw whole frames, each in an engine of its own, which is not reset
/// between them. Where lanes would pay, see lanes_pay(), and cannot be had, Verilator draws, with a note. A
/// frame that differs, or in which the engine ends with a fault, is drawn again in Verilator, unless that
/// drew it: Verilator reports more, the cycle of a fault and the fragments before it. If Verilator finds no
/// difference, the engine is wrong: an error with the exit code `differs`. Memory is bounded by the threads,
/// by the frame, and by SceneStream and the engine, not by the number of frames or of triangles. Ends after
/// the first frame that differs, which is no error: see ViewSummary::difference.
Result<ViewSummary> view(const Scene& scene, const ViewSettings& settings);

/// Two lines: frames a second, mismatches; the parts of a frame's time.
std::string to_lines(const ViewSummary& summary);

}  // namespace halfway

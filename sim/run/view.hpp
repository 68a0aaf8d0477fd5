// SPDX-License-Identifier: Apache-2.0
// A turntable: one scene from all sides, by one piece of hardware.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "frame/frame.hpp"
#include "scene/scene.hpp"
#include "sim/driver/engine.hpp"
#include "sim/driver/rtl_frame.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/run/draw_knobs.hpp"

namespace halfway {

inline constexpr std::uint32_t c_most_view_frames = 10'000;

struct ViewSettings : DrawRequest {
  std::uint32_t frames = 36;           ///< of one turn; 1 to c_most_view_frames
  bool compare = true;                 ///< false: the golden model does not draw
  std::optional<EngineKind> engine{};  ///< std::nullopt: lanes if possible and faster, otherwise Verilator
  SimulatorFolders folders{};
  /// Called with the key and the engine before the hardware is built.
  std::function<void(const std::string& key, EngineKind engine)> on_build = [](const std::string&,
                                                                               EngineKind) {};
  /// Called when the hardware is built, before anything is drawn.
  std::function<void()> on_ready = [] {};
  /// Called with each frame when it is drawn, by several threads at the same time and in any order.
  std::function<void(std::uint32_t number, const Frame& frame)> on_drawn = [](std::uint32_t, const Frame&) {};
  /// Called with each frame in order, one at a time, after on_drawn.
  std::function<void(std::uint32_t number, const Frame& frame)> on_next = [](std::uint32_t, const Frame&) {};
};

/// The first frame with a difference from the golden model or a fault of the hardware.
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
  std::uint64_t in_view = 0;                  ///< maximum number of triangles in a frame
  std::uint64_t reference_pixels = 0;         ///< maximum over the frames without a fragment
  EngineKind engine = EngineKind::verilator;  ///< the engine that drew
  std::vector<std::uint32_t> drawn_again;     ///< frames that Verilator drew again
  unsigned threads = 1;
  double seconds = 0.0;  ///< from the end of the build until the last frame was output
  FrameSeconds parts;
  double image_seconds = 0.0;  ///< of processor time, for on_drawn
  std::optional<ViewDifference> difference;
  std::vector<std::string> notes;  ///< remarks for a reader of the figures
  /// As SceneSummary::nothing_compared, for all frames; std::nullopt if no comparison was requested.
  std::optional<std::string> nothing_compared() const;
  double rate() const { return seconds > 0.0 ? frames / seconds : 0.0; }
};

/// Draws the scene from `frames` places around its camera's target. Hardware is planned and built once,
/// because no effect depends on the camera. Each thread draws whole frames in its own engine, which is not
/// reset between them. If lanes would save time (c_least_lane_pixels) but cannot be built, Verilator draws,
/// with a note. If a frame of lanes differs or ends with a fault, Verilator draws it again, because it
/// reports more: the cycle of a fault, and the fragments before it. If Verilator finds no difference, the
/// lanes are wrong: a Failure with the exit code `differs`. Memory depends on the threads, the frame size,
/// the engine, not on the number of frames or triangles. Ends after the first frame that
/// differs, which is not an error: see ViewSummary::difference.
ViewSummary view(const Scene& scene, const ViewSettings& settings);

/// Two lines: frames per second and mismatches; the parts of a frame's time.
std::string to_lines(const ViewSummary& summary);

}  // namespace halfway

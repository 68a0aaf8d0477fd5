// SPDX-License-Identifier: Apache-2.0
// One scene drawn frame by frame by one piece of hardware, with its golden model and its reference. It needs
// no threads, files or clock, so a browser runs it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"
#include "frame/metrics.hpp"
#include "golden_run/golden_run.hpp"
#include "plan/plan.hpp"
#include "reference/renderer.hpp"
#include "setup/setup.hpp"
#include "sim/driver/engine.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/driver/pixel_way.hpp"
#include "sim/extras/live_core/live_scene.hpp"

namespace halfway::live {

// Names of what the page and the core exchange, in the order of their arrays: Settings, the numbers of
// live_figures, and Picture.
inline constexpr std::array c_setting_names = {"width",        "height",         "azimuth",
                                               "elevation",    "distance",       "exponent",
                                               "lightAzimuth", "lightElevation", "threshold"};
inline constexpr std::array c_figure_names = {"fragments", "mismatches", "triangles", "leaves",
                                              "words",     "clocks",     "rms",       "largest",
                                              "setup",     "golden",     "hardware",  "compare"};
inline constexpr std::array c_picture_names = {"hardware", "golden", "reference", "difference", "triangles"};

/// Of the last drawn frame.
struct Figures {
  std::uint64_t fragments = 0;   ///< of the hardware
  std::uint64_t mismatches = 0;  ///< fragments that differ from the golden model's in any field
  std::uint64_t words = 0;       ///< of the whole stream: loads, headers and line records
  SetupCounts setup;
  std::optional<std::uint64_t> hardware_clocks;  ///< WalkCounts::clocks; empty: no model of them
  FrameSeconds seconds;
  std::optional<FrameDistance> error;  ///< of the hardware's frame against the reference
};

enum class Picture {
  hardware,
  golden,
  reference,
  difference,  ///< of hardware and reference, times c_difference_scale
  /// The triangles as they were split: a colour for each header of the stream. With shadows, where a header
  /// draws one line, for each triangle of the scene.
  split,
};

/// A simulation of the hardware with the signals of its stages.
struct Observation {
  SignalTrace trace;
  std::string fault;  ///< empty: none
};
/// Draws init vectors as a single stream from reset, `most` fragments at most.
using Observe = std::function<Result<Observation>(std::span<const std::uint32_t> init_words,
                                                  const ShaderStages& stages, std::uint64_t most)>;

/// What `make why` shows, for hardware in a browser.
struct Way {
  std::vector<PixelStory> stories;
  std::optional<FirstDifference> first;
  std::string fault;
};

/// The way as text for the page: one line for each item, its fields separated by tabs:
///   triangle  number, number of its init vector
///   given     what: "init vector" or "line's record"
///   stage     name, cycle: empty if the RTL has no such event
///   value     name, golden model's, RTL's, "equal" or "differs"; of a given value only the first two
///   first     the first difference, with its stage and entity
///   fault     message
/// A triangle precedes its given values and stages, and these their values.
std::string lines_of(const Way& way);

/// The hardware that draws the scene in a browser: plan_scene's, but folded for the shading processors of
/// many lights in preset `exact`. Their unrolled form takes minutes and 6 GB of memory to compile to
/// WebAssembly.
Result<HardwareKey> planned_key(const Scene& scene, PlanRequest request);

class LiveFrame {
 public:
  /// `now` is a clock in seconds.
  explicit LiveFrame(std::function<double()> now) : now_(std::move(now)) {}

  /// Replaces the scene (read_scene). After an error there is none.
  Status load(std::string_view file, std::string_view text, double tessellation = 1.0);
  /// Plans the hardware for the scene. All frames until the next plan are drawn for this key.
  Result<HardwareKey> plan(const PlanRequest& request);

  /// Draws a frame: set-up, hardware, golden model, comparison of every field, picture. A difference or a
  /// fault of the hardware is an error with the exit code `differs`, which starts with the fault, if any, and
  /// lists the first fragments that differ. The pictures and figures are then valid, too. Other errors leave
  /// the last frame.
  Status draw(const Settings& settings, Engine& hardware);
  /// Draws the reference of the last frame, and measures the frame's error.
  Status draw_reference();
  /// A picture of the last frame. Golden model and split triangles are drawn when they are requested.
  Result<Frame> picture(Picture kind);
  /// The way of a pixel of the last frame through the stages. The simulation also draws the triangle with the
  /// frame's first fragment that differs.
  Result<Way> way(FramePixel pixel, const Observe& observe);
  const Figures& figures() const { return figures_; }

 private:
  Status check_planned() const;
  SetupOptions setup_options(const Settings& settings);
  /// Of a frame of the planned hardware.
  FrameDriver driver_of(const Settings& settings, std::vector<std::shared_ptr<Engine>> engines,
                        GoldenDraws golden);
  Result<Frame> draw_golden(Picture kind);

  std::function<double()> now_;
  std::optional<LiveScene> scene_;
  std::optional<HardwareKey> key_;
  std::shared_ptr<const Bells> bells_;  ///< of this factor
  double bells_factor_ = 1.0;
  std::optional<Settings> drawn_;  ///< of the last frame
  std::optional<Frame> hardware_;
  std::optional<ReferenceImage> reference_;
  Figures figures_;
  std::uint64_t first_wrong_ =
      UINT64_MAX;  ///< number of the first fragment that differs, in the golden model
};

}  // namespace halfway::live

// SPDX-License-Identifier: Apache-2.0
// A frame drawn by an engine. Its fragments are compared with the golden model's and assembled to a picture.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "golden_run/golden_run.hpp"
#include "scene/scene.hpp"
#include "sim/driver/engine.hpp"
#include "sim/driver/hardware_frame.hpp"
#include "sim/driver/stream_comparator.hpp"
#include "sim/files/trace.hpp"
#include "sim/os/seconds.hpp"
#include "sim/run/scene_stream.hpp"

namespace halfway {

/// Result of a simulator for a scene.
struct SimulatorRun {
  std::string simulator;
  std::uint64_t fragments = 0, mismatches = 0;
  /// Of the whole run; std::nullopt if a fault ended it before the simulator could report them.
  std::optional<std::uint64_t> cycles;
  std::uint64_t parts = 1;        ///< number, each after a reset; several need more cycles than one
  std::optional<double> seconds;  ///< elapsed time of the engine; std::nullopt as for cycles
  std::string fault;              ///< of the hardware, as reported by the simulator; empty: none
  std::string description;        ///< the first mismatches and their counts; empty: none
  std::vector<Mismatch> first;
  std::vector<std::filesystem::path> evidence;  ///< difference image, waveform
  bool equal() const { return mismatches == 0 && fault.empty(); }
};

struct RtlFrameOptions {
  std::optional<Tile> tile{};  ///< the part of the frame to store; std::nullopt: all of it
  /// Draws the golden fragments here, a few triangles at a time, when the engine's fragments are compared;
  /// they are not stored. Null: the caller passes them to add().
  std::shared_ptr<GoldenModel> golden{};
  /// False: the golden model, which must not be null, only counts the expected fragments.
  bool compare = true;
  /// For an engine that draws late: golden fragments are read from this trace instead of being stored. It
  /// must be complete when finish() is called. Empty: they are stored.
  std::filesystem::path golden_trace{};
  Engine::OnDrawn on_drawn{};  ///< also called with the engine's fragments
};

class RtlFrame {
 public:
  RtlFrame(std::shared_ptr<Engine> engine, FrameSize size, glm::dvec3 background,
           RtlFrameOptions options = {});

  /// Starts another frame in the same memory.
  void clear();

  /// Draws vectors of whole triangles; `golden` are the golden model's fragments for them. A fault of the
  /// hardware ends the drawing, but is not an error: see SimulatorRun::fault.
  Status add(std::span<const std::uint32_t> init_words, std::span<const Fragment> golden = {});
  /// Ends the frame.
  Status finish();
  /// Draws a scene's complete stream. Returns bad input if the scene cannot be drawn.
  Status draw(const Scene& scene, SceneStream& stream);
  /// Call it after finish().
  SimulatorRun result();

  const Engine& engine() const { return *engine_; }
  /// False after a fault: later fragments are invalid.
  bool alive() const { return frame_.alive(); }
  const FrameAssembler& assembler() const { return frame_.assembler(); }

  /// Processor seconds of this thread.
  struct Seconds {
    double rtl, golden, compare, assemble;
  };
  Seconds seconds() const;

 private:
  Status ended(const Status& drawn);
  void take(std::span<const Fragment> drawn);
  /// Compares fragments with the next golden ones: `golden_count` of them, or all that remain. Returns the
  /// number of golden fragments.
  std::size_t compare(std::span<const Fragment> drawn, std::size_t golden_count);
  /// Valid until the next call.
  std::span<const Fragment> next_golden(std::size_t count);

  std::shared_ptr<Engine> engine_;
  RtlFrameOptions o_;
  StreamComparator comparator_;
  HardwareFrame frame_;
  std::span<const std::uint32_t> words_;  ///< of this call, not yet drawn by the golden model
  std::span<const Fragment> given_;       ///< of this call, not yet compared
  std::optional<TraceReader> trace_;
  std::vector<Fragment> read_;
  std::uint64_t golden_count_ = 0;  ///< golden fragments compared so far
  Stretch stretch_;
  double golden_clock_ = 0.0, compare_clock_ = 0.0, assemble_clock_ = 0.0;  ///< elapsed seconds of its pieces
  std::optional<Error> error_;                                              ///< when reading the golden trace
};

}  // namespace halfway

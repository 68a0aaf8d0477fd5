// SPDX-License-Identifier: Apache-2.0
// A frame that an engine draws: its fragments compared with the golden model's and assembled to a picture.
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
#include "frame/assemble.hpp"
#include "golden_run/golden_run.hpp"
#include "scene/scene.hpp"
#include "sim/compare/stream_comparator.hpp"
#include "sim/engine/engine.hpp"
#include "sim/run/scene_stream.hpp"
#include "sim/stream_files/trace.hpp"
#include "sim/system/seconds.hpp"

namespace halfway {

/// What a simulator made of a scene.
struct SimulatorRun {
  std::string simulator;
  std::uint64_t fragments = 0, mismatches = 0;
  /// Of the whole run; none where a fault ended it before its simulator could say.
  std::optional<std::uint64_t> cycles;
  std::uint64_t parts = 1;        ///< each from the reset on: some cycles more than in one
  std::optional<double> seconds;  ///< of the engine, by the clock; none as for cycles
  std::string fault;              ///< of the hardware, as the simulator tells it; empty: none
  std::string description;        ///< the first mismatches and their counts; empty: none
  std::vector<Mismatch> first;
  std::vector<std::filesystem::path> evidence;  ///< difference image, waveform
  bool equal() const { return mismatches == 0 && fault.empty(); }
};

struct RtlFrameOptions {
  std::optional<Tile> tile{};  ///< the frame's part that is kept; none: all of it
  /// Draws the golden fragments here, a few triangles at a time, when the engine's come: they are not kept.
  /// Null: add() is given them.
  std::shared_ptr<GoldenModel> golden{};
  /// Else the golden model, which must be here, only tells how many fragments are to come.
  bool compare = true;
  /// Of an engine that draws late: golden fragments are read from this trace, not kept. It must be whole when
  /// finish() is called. Empty: they are kept.
  std::filesystem::path golden_trace{};
  Engine::OnDrawn on_drawn{};  ///< sees the engine's fragments too
};

class RtlFrame {
 public:
  RtlFrame(std::shared_ptr<Engine> engine, FrameSize size, glm::dvec3 background,
           RtlFrameOptions options = {});

  /// Begins another frame, in the same room.
  void clear();

  /// The vectors of whole triangles and what the golden model draws for them. A fault of the hardware ends
  /// the drawing and is no error: see SimulatorRun::fault.
  Status add(std::span<const std::uint32_t> init_words, std::span<const Fragment> golden = {});
  /// No more will come.
  Status finish();
  /// All of a scene's stream, to its end; bad input where the scene cannot be drawn.
  Status draw(const Scene& scene, SceneStream& stream);
  /// After finish().
  SimulatorRun result();

  const Engine& engine() const { return *engine_; }
  /// False after a fault: what the engine draws is worth nothing from then on.
  bool alive() const { return alive_; }
  const FrameAssembler& assembler() const { return assembler_; }

  /// Processor seconds of this thread.
  struct Seconds {
    double rtl, golden, compare, assemble;
  };
  Seconds seconds() const;

 private:
  std::uint64_t most() const;
  Status ended(const Status& drawn);
  void take(std::span<const Fragment> drawn);
  /// Compares fragments with the golden model's next ones, of which there are `golden_count` or all. Gives
  /// how many there were.
  std::size_t compare(std::span<const Fragment> drawn, std::size_t golden_count);
  /// Valid until the next call.
  std::span<const Fragment> next_golden(std::size_t count);
  void assemble(std::span<const Fragment> fragments);

  std::shared_ptr<Engine> engine_;
  RtlFrameOptions o_;
  StreamComparator comparator_;
  FrameAssembler assembler_;
  std::span<const std::uint32_t> words_;  ///< of this call, for which the golden model has not drawn
  std::span<const Fragment> given_;       ///< of this call, not compared yet
  std::optional<TraceReader> trace_;
  std::vector<Fragment> read_;
  std::uint64_t expected_ = 0, count_ = 0, golden_count_ = 0;  ///< fragments, of the vectors so far
  Stretch stretch_;
  double golden_clock_ = 0.0, compare_clock_ = 0.0, assemble_clock_ = 0.0;  ///< parts of it
  std::string fault_;
  bool alive_ = true;
  std::optional<Error> error_;  ///< of the golden trace
};

}  // namespace halfway

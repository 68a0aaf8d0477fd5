// SPDX-License-Identifier: Apache-2.0
// A frame drawn by an engine. Its fragments are counted, limited, compared with the golden model's and
// assembled to a picture.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/host.hpp"
#include "common/result.hpp"
#include "frame/assemble.hpp"
#include "golden_run/golden_run.hpp"
#include "sim/driver/engine.hpp"
#include "sim/driver/stream_comparator.hpp"

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
  std::vector<std::string> evidence;  ///< files: difference image, waveform
  bool equal() const { return mismatches == 0 && fault.empty(); }
};

/// Gives the next golden fragments of a stored stream, at most `most`; none at its end.
using GoldenSource = std::function<Result<std::span<const Fragment>>(std::size_t most)>;

struct RtlFrameOptions {
  std::optional<Tile> tile{};  ///< the part of the frame to store; std::nullopt: all of it
  /// Draws the golden fragments here, a few triangles at a time, when the engine's fragments are compared;
  /// they are not stored. Null: the caller passes them to add().
  std::shared_ptr<GoldenModel> golden{};
  /// False: the golden model, which must not be null, only counts the expected fragments.
  bool compare = true;
  /// For an engine that draws late: golden fragments come from here, while it draws, instead of being stored.
  GoldenSource late_golden{};
  Engine::OnDrawn on_drawn{};  ///< also called with the engine's fragments
  Clocks clocks{};
};

/// Processor seconds of a frame's parts.
struct FrameSeconds {
  double setup = 0.0, golden = 0.0, rtl = 0.0, compare = 0.0, assemble = 0.0;
  FrameSeconds& operator+=(const FrameSeconds& other);
  double sum() const { return setup + golden + rtl + compare + assemble; }
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
  /// Call it after finish().
  SimulatorRun result();

  const Engine& engine() const { return *engine_; }
  /// False after a fault: later fragments are invalid.
  bool alive() const { return alive_; }
  /// A fault of the frame's own golden model.
  bool golden_fault() const { return o_.golden && o_.golden->fault(); }
  const FrameAssembler& assembler() const { return assembler_; }
  const StreamComparator& comparator() const { return comparator_; }

  FrameSeconds seconds() const;  ///< of its calls

 private:
  template <class Work>
  Status timed(const Work& work);
  /// Upper limit of further fragments: the expected ones and a surplus. More means that the hardware runs
  /// away.
  std::uint64_t most() const;
  Status ended(const Status& drawn);
  void take(std::span<const Fragment> drawn);
  void assemble(std::span<const Fragment> drawn);
  /// Compares fragments with the next golden ones: `golden_count` of them, or all that remain. Returns the
  /// number of golden fragments.
  std::size_t compare(std::span<const Fragment> drawn, std::size_t golden_count);
  /// Valid until the next call.
  std::span<const Fragment> next_golden(std::size_t count);

  std::shared_ptr<Engine> engine_;
  RtlFrameOptions o_;
  StreamComparator comparator_;
  FrameAssembler assembler_;
  std::uint64_t expected_ = 0, fragments_ = 0;
  std::string fault_;
  bool alive_ = true;
  std::span<const std::uint32_t> words_;  ///< of this call, not yet drawn by the golden model
  std::span<const Fragment> given_;       ///< of this call, not yet compared
  std::uint64_t golden_count_ = 0;        ///< golden fragments compared so far
  bool finishing_ = false;
  /// Seconds of all calls. Reading the processor clock takes almost a microsecond, so pieces of a call are
  /// measured in elapsed time, and each is assigned the same share of the processor time.
  double processor_ = 0.0, elapsed_ = 0.0;
  double golden_elapsed_ = 0.0, compare_elapsed_ = 0.0, assemble_elapsed_ = 0.0;
  std::optional<Error> error_;  ///< of the golden source
};

}  // namespace halfway

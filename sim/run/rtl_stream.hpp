// SPDX-License-Identifier: Apache-2.0
// A simulator's fragments on their way: compared with the golden model's, assembled to a frame.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "frame/assemble.hpp"
#include "sim/compare/stream_comparator.hpp"
#include "sim/verilator/verilator_simulator.hpp"

namespace halfway {

/// What a simulator made of a scene.
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

class RtlStream {
 public:
  /// Without `compare` no golden fragments are added, and none are missed.
  RtlStream(FrameSize size, glm::dvec3 background, bool compare = true)
      : compares_(compare), assembler_(size, background) {}
  /// Keeps a tile of the frame alone.
  RtlStream(FrameSize size, const Tile& tile, glm::dvec3 background)
      : compares_(true), assembler_(size, tile, background) {}

  /// Begins another frame, in the same room.
  void clear();

  void add_golden(std::span<const Fragment> fragments);
  void add(std::span<const Fragment> fragments);
  /// Both of the same vectors, without a copy.
  void add(std::span<const Fragment> golden, std::span<const Fragment> fragments);
  void set_fault(std::string fault) { fault_ = std::move(fault); }

  bool compares() const { return compares_; }
  std::uint64_t count() const { return count_; }
  std::uint64_t golden_count() const { return golden_count_; }
  const FrameAssembler& assembler() const { return assembler_; }
  /// By the clock.
  double compare_seconds() const { return compare_seconds_; }
  double assemble_seconds() const { return assemble_seconds_; }

  /// No more will come, of either.
  SimulatorRun finish(std::string simulator);

 private:
  using Clock = std::chrono::steady_clock;
  void assemble(std::span<const Fragment> fragments);
  void assemble_compared(Clock::time_point start, std::span<const Fragment> fragments);

  bool compares_;
  StreamComparator comparator_;
  FrameAssembler assembler_;
  std::uint64_t count_ = 0, golden_count_ = 0;
  double compare_seconds_ = 0.0, assemble_seconds_ = 0.0;
  std::string fault_;
};

/// Feeds a model in Verilator the init vectors of one frame, and an RtlStream what it draws. A fault of the
/// hardware goes into the stream and ends the feeding. Where nothing is compared, it draws 2^22 fragments at
/// a time at most, or one vector's, and what a few vectors in the hardware are behind; else as many as a
/// call's vectors cover.
class VerilatorFeed {
 public:
  using OnDrawn = std::function<void(std::span<const Fragment>)>;

  /// Simulator and stream must outlive the feed; `on_drawn` sees the fragments too, in their order.
  VerilatorFeed(VerilatorSimulator& simulator, RtlStream& rtl, OnDrawn on_drawn = {});

  /// Where the stream compares, it must have the golden model's fragments for these vectors.
  Status add(std::span<const std::uint32_t> init_words);
  /// Until the hardware is empty.
  Status finish();
  /// False after a fault: nothing that this model draws is worth anything from then on.
  bool alive() const { return alive_; }
  double seconds() const { return seconds_; }  ///< that the simulator took

 private:
  std::size_t limit() const;
  Status take(const Status& ran);

  VerilatorSimulator& simulator_;
  RtlStream& rtl_;
  OnDrawn on_drawn_;
  std::vector<Fragment> drawn_;
  bool alive_ = true;
  double seconds_ = 0.0;
};

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// A shader's RTL in lanes: many copies of the hardware in one vector of the processor, each with its own
// triangles. The fragments equal those of VerilatorSimulator. Several times faster, but without waveforms.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "plan/hardware_key.hpp"
#include "sim/driver/engine.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/extras/lanes/lane_library.hpp"

namespace halfway {

struct LaneOptions {
  unsigned threads = 1;                ///< each with its own lanes
  std::uint64_t idle_limit = 100'000;  ///< cycles without progress in a lane that count as a hang
  /// Fragments per thread that wait for an earlier part. At this number no further part is started.
  std::size_t most_waiting = std::size_t{1} << 21;
  std::uint32_t stall_seed =
      0;             ///< 0: full speed; otherwise both streams stall at random, separately in each lane
  bool fast = true;  ///< optimize, which takes long to compile
  LaneVectors vectors = LaneVectors::avx512;
};

/// The build of a shader's lanes. Throws Failure.
LaneBuild lane_build_of(const HardwareKey& key, const SimulatorFolders& folders,
                        const LaneOptions& options = {});

class LaneSimulator final : public Engine {
 public:
  /// Builds the lanes, or takes them from the cache, and resets them. Hardware without lanes is an error with
  /// a message; a caller such as view() with `auto` then uses VerilatorSimulator. Refused are netlists with
  /// constructs that the generator does not support.
  static Result<LaneSimulator> open(const HardwareKey& key, const SimulatorFolders& folders,
                                    const LaneOptions& options = {});

  EngineKind kind() const override { return EngineKind::lanes; }
  Result<std::shared_ptr<Engine>> another() const override;
  /// Draws all vectors of the call, units whole (GoldenModel::unit), and outputs fragments part by part in
  /// the order of a single stream, for any number of lanes and threads. `on_drawn` is called by this thread.
  /// It is a fault if the fragments exceed the pixels covered by the vectors by more than c_most_surplus.
  /// After an error the next call starts with reset lanes. Use thousands of vectors per call for speed.
  ///
  /// A lane that has drawn its part starts the next one. Lanes wait for each other only at the end of a call,
  /// or if `most_waiting` fragments wait. Memory does not depend on the number of vectors: the lanes of a
  /// thread store at most that many fragments plus one larger part or triangle, in buffers of up to four
  /// times that size. Buffers for 2^21 fragments in total are kept for the next call.
  Status draw(std::span<const std::uint32_t> init_words, std::uint64_t most,
              const OnDrawn& on_drawn) override;
  Status drain(std::uint64_t, const OnDrawn&) override { return Ok{}; }
  /// std::nullopt: the clocks of lanes are not those of a single stream.
  std::optional<std::uint64_t> cycles() const override { return std::nullopt; }

  /// Clocks of all lanes while they had something to draw, summed. This exceeds the clocks of a single
  /// hardware, because the pipeline runs empty at the end of each part.
  std::uint64_t lane_cycles() const;

 private:
  struct Hardware;  // shared by all objects for the same hardware
  struct State;
  class Passage;
  explicit LaneSimulator(std::shared_ptr<State> state) : state_(std::move(state)) {}
  std::shared_ptr<State> state_;
};

}  // namespace halfway

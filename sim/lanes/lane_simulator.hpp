// SPDX-License-Identifier: Apache-2.0
// A shader's RTL in lanes: many copies of the hardware in one vector of the processor, each with triangles of
// its own. The same fragments as from VerilatorSimulator, several times as fast; no waves.
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
#include "sim/engine/engine.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway {

struct LaneOptions {
  unsigned threads = 1;                ///< each with lanes of its own
  std::uint64_t idle_limit = 100'000;  ///< cycles in which nothing moves in a lane: a hang
  /// Fragments a thread that wait for a part in front of theirs, from which on no part is begun.
  std::size_t most_waiting = std::size_t{1} << 21;
  std::uint32_t stall_seed =
      0;                   ///< 0: full speed; else both streams stall at random, in each lane for itself
  bool fast = true;        ///< worth a long compilation
  std::string compiler{};  ///< empty: clang++ where it is installed, else g++
};

class LaneSimulator final : public Engine {
 public:
  /// Why there are no lanes for hardware of this key, whatever its netlist; empty where there may be.
  static std::string refused(const HardwareKey& key);

  /// Builds the lanes, or takes them from the cache, and resets them. What lanes cannot be had for is an
  /// error that says so: who may, as view() in `auto`, takes VerilatorSimulator. Such are the processors
  /// shader, whose lights and counters outlive a triangle, and a netlist with what the generator does not
  /// know.
  static Result<LaneSimulator> open(const HardwareKey& key, const SimulatorFolders& folders,
                                    const LaneOptions& options = {});

  EngineKind kind() const override { return EngineKind::lanes; }
  Result<std::shared_ptr<Engine>> another() const override;
  /// Draws from idle to idle, and hands on fragments part by part in the order of a single stream, whatever
  /// the number of lanes and threads; this thread calls `on_drawn`. More fragments than the vectors cover,
  /// and some, are a fault. After an error the next call begins with lanes just reset. More vectors in a call
  /// are faster: thousands.
  ///
  /// Lanes go on from part to part and wait for one another at a call's end alone, and where `most_waiting`
  /// fragments wait. Memory does not grow with a call's vectors: a thread's lanes hold that many and a part
  /// or triangle that covers more, in room for four times as many at most; room for 2^21 in all stays for
  /// what comes next.
  Status draw(std::span<const std::uint32_t> init_words, std::uint64_t most,
              const OnDrawn& on_drawn) override;
  Status drain(std::uint64_t, const OnDrawn&) override { return Ok{}; }
  /// None: the clocks of lanes are not the stream's.
  std::optional<std::uint64_t> cycles() const override { return std::nullopt; }

  /// Clocks of all lanes while they had something to draw, summed: more than one hardware would need, as each
  /// part ends with the pipeline running empty.
  std::uint64_t lane_cycles() const;

 private:
  struct Hardware;  // what others of the same share
  struct State;
  class Passage;
  explicit LaneSimulator(std::shared_ptr<State> state) : state_(std::move(state)) {}
  std::shared_ptr<State> state_;
};

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// A shader's RTL in Verilator, in this process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "frame/fragment.hpp"
#include "plan/hardware_key.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway {

struct VerilatorOptions {
  std::uint32_t stall_seed = 0;  ///< 0: full speed; else both streams stall at random, as in tb/frame_tb.vhd
  std::uint64_t idle_limit = 100'000;  ///< cycles in which nothing moves: a hang
  std::filesystem::path wave_file{};   ///< FST; empty: none. Another cached build, several times slower
  std::uint64_t waves_from = 0, waves_to = UINT64_MAX;  ///< cycles [from, to)
  std::string compiler{};                               ///< empty: clang++ where it is installed, else g++
  bool plain_eval = false;  ///< only through Verilator's eval(), to test the harness's shorter way
  /// Verilog with the key's top and its ports, in place of what GHDL makes of the RTL; such as what Yosys
  /// makes of that.
  std::string netlist{};
};

class VerilatorSimulator {
 public:
  /// Builds the model, or takes it from the cache, and resets it.
  static Result<VerilatorSimulator> open(const HardwareKey& key, const SimulatorFolders& folders,
                                         const VerilatorOptions& options = {});
  /// Another model of the same hardware, reset, with the same options, for another thread; without
  /// waveforms.
  Result<VerilatorSimulator> another() const;

  unsigned init_bits() const;

  /// Feeds `vector_count` vectors and returns when the last is taken: its fragments, and more, may come with
  /// the next call. Fragments are appended to `out`; more than `max_fragments` in `out` is an error. A fault
  /// of the hardware (a hang, a payload that does not stand still) has the exit code `differs`.
  Status run(std::span<const std::uint32_t> init_words, std::size_t vector_count, std::vector<Fragment>& out,
             std::size_t max_fragments);
  /// Goes on until the hardware is empty.
  Status finish(std::vector<Fragment>& out, std::size_t max_fragments);

  /// From the first vector taken to the last vector or fragment that moved, both counted, as in a trace.
  std::uint64_t cycles() const;

 private:
  struct Hardware;  // what others of the same share
  struct State;
  static Result<VerilatorSimulator> with_model(std::shared_ptr<State> state);
  explicit VerilatorSimulator(std::shared_ptr<State> state) : state_(std::move(state)) {}
  Status advance(const std::uint32_t* words, std::size_t vectors, bool drain, std::vector<Fragment>& out,
                 std::size_t max_fragments);
  std::shared_ptr<State> state_;
};

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// A shader's RTL in Verilator, in this process.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "frame/fragment.hpp"
#include "plan/hardware_key.hpp"
#include "sim/driver/engine.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway {

struct VerilatorOptions {
  std::uint32_t stall_seed = 0;        ///< 0: full speed; otherwise random stalls as in tb/rtl/frame_tb.vhd
  std::uint64_t idle_limit = 100'000;  ///< cycles without progress that count as a hang
  std::filesystem::path wave_file{};   ///< FST; empty: none. Uses another cached build, several times slower
  std::uint64_t waves_from = 0, waves_to = UINT64_MAX;  ///< cycles [from, to)
  std::string compiler{};                               ///< empty: clang++ if installed, otherwise g++
  /// Verilog with the key's top and its ports, which replaces GHDL's netlist of the RTL. For example that
  /// netlist after synthesis by Yosys.
  std::string netlist{};
};

class VerilatorSimulator final : public Engine {
 public:
  /// Builds the model, or takes it from the cache, and resets it.
  static Result<VerilatorSimulator> open(const HardwareKey& key, const SimulatorFolders& folders,
                                         const VerilatorOptions& options = {});

  EngineKind kind() const override { return EngineKind::verilator; }
  /// The other engine writes no waveforms.
  Result<std::shared_ptr<Engine>> another() const override;
  /// Returns when the last vector is accepted. A payload that changes while it waits is a fault, too.
  Status draw(std::span<const std::uint32_t> init_words, std::uint64_t most,
              const OnDrawn& on_drawn) override;
  Status drain(std::uint64_t most, const OnDrawn& on_drawn) override;
  std::optional<std::uint64_t> cycles() const override;

 private:
  struct Hardware;  // shared by all objects for the same hardware
  struct State;
  static Result<VerilatorSimulator> with_model(std::shared_ptr<State> state);
  explicit VerilatorSimulator(std::shared_ptr<State> state) : state_(std::move(state)) {}
  Status advance(std::span<const std::uint32_t> init_words, bool drain, std::uint64_t most,
                 const OnDrawn& on_drawn);
  std::shared_ptr<State> state_;
};

}  // namespace halfway

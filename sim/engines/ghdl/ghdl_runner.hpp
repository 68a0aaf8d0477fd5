// SPDX-License-Identifier: Apache-2.0
// Runs a shader's RTL in GHDL with tb/rtl/frame_tb.vhd: reads an init file, writes a trace.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "plan/hardware_key.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway {

struct GhdlRunOptions {
  std::uint32_t max_fragments = 0x7fffffff;
  std::uint32_t idle_limit = 100'000;  ///< cycles without progress that count as a hang
  std::uint32_t stall_seed = 0;        ///< 0: full speed; otherwise both streams stall at random
  std::function<void(std::uintmax_t trace_bytes)> on_progress{};  ///< argument: bytes written so far
  std::filesystem::path wave_file{};                              ///< .fst or .vcd; empty: none
  /// Signals in the wave file, such as frame_tb/dut/walker/x; empty: every signal. A signal of a generate
  /// loop selects it in all iterations.
  std::vector<std::string> wave_signals{};
};

struct GhdlRun {
  std::uint64_t fragments = 0, cycles = 0;
};

class GhdlRunner {
 public:
  /// Analyses the RTL and the testbench unless the cache has them.
  static Result<GhdlRunner> open(const HardwareKey& key, const SimulatorFolders& folders);

  /// Writes `trace_file`, under a temporary name until it is complete. A fault of the hardware that the
  /// testbench detects (a hang, a metavalue, a payload that changes while it waits) is an error with the exit
  /// code `differs`.
  Result<GhdlRun> run(const std::filesystem::path& init_file, const std::filesystem::path& trace_file,
                      const GhdlRunOptions& options = {}) const;

 private:
  GhdlRunner(const HardwareKey& key, GhdlLibrary library) : key_(key), library_(std::move(library)) {}
  HardwareKey key_;
  GhdlLibrary library_;
};

}  // namespace halfway

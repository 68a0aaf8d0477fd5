// SPDX-License-Identifier: Apache-2.0
// halfway_core in Verilator, with a memory at its AXI4 port and a host at its AXI4-Lite port.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "golden/frame_memory.hpp"
#include "plan/hardware_key.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/extras/core/axi_memory.hpp"
#include "sim/os/shared_library.hpp"

namespace halfway::core {

using golden::PixelFormat;

/// Where the core sees its memory in simulations of whole frames.
inline constexpr std::uint32_t c_memory_address = 0x1000'0000;
/// More than any frame takes.
inline constexpr std::uint64_t c_most_frame_clocks = 1'000'000'000;

/// The core to elaborate.
struct CoreKey {
  HardwareKey shader;
  PixelFormat format = PixelFormat::rgb565;
  unsigned bus_bits = 64;   ///< 32 or 64
  unsigned limit_bits = 0;  ///< g_limit_bits of words_to_fragments; 0: the default

  std::vector<std::pair<std::string, std::string>> generics() const;
  std::string name() const;
};

/// Its functions throw Failure.
class CoreSimulator {
 public:
  /// Builds the model, or takes it from the cache, and resets it. Connect its memory before it draws.
  CoreSimulator(const CoreKey& key, MemoryTiming timing, const SimulatorFolders& folders);

  void clock();

  struct Answer {
    std::uint32_t value;
    std::uint8_t response;  ///< of AXI4-Lite: 0, or 2 for an error
  };
  Answer read(std::uint32_t address);
  /// `strobes`: the bytes to write. Returns the response.
  std::uint8_t write(std::uint32_t address, std::uint32_t value, unsigned strobes = 15);

  /// Lets clocks pass until the core interrupts. More than `most` have the code `differs`.
  void wait(std::uint64_t most);

  bool interrupt() const { return outputs_.interrupt != 0; }
  std::uint32_t picture() const { return outputs_.picture; }  ///< the port
  std::uint64_t clocks() const { return clocks_; }            ///< since the start
  AxiMemory& memory() { return memory_; }

 private:
  SharedLibrary library_;
  std::unique_ptr<CoreModel> core_;
  AxiMemory memory_;
  CoreInputs inputs_{};
  CoreOutputs outputs_{};
  std::uint64_t clocks_ = 0;
};

}  // namespace halfway::core

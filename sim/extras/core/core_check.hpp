// SPDX-License-Identifier: Apache-2.0
// Draws a frame by the driver on the simulated core, and compares the memory with the golden model's. Or the
// core is a device that another program uses.
#pragma once

#include <cstdint>
#include <filesystem>

#include "scene/scene.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/extras/core/core_simulator.hpp"

namespace halfway::core {

struct CoreCheckOptions {
  FrameSize size;
  FrameOptions frame{};  ///< of set-up and golden model
  MemoryTiming timing{};
  std::filesystem::path picture{};  ///< a file for the picture
};

/// Of the core's counters, and of the memory.
struct CoreFigures {
  std::uint64_t triangles = 0, fragments = 0, pixels = 0, clocks = 0, stalled_clocks = 0;
  std::uint64_t words_read = 0, words_written = 0;
};

/// Every byte of the memory must be as before, but for the pixels of picture and depth buffer, which must be
/// the golden model's. Throws Failure, of the code `differs` for a difference. Writes the picture.
CoreFigures check_core(const Scene& scene, const CoreKey& key, const CoreCheckOptions& options,
                       const SimulatorFolders& folders);

struct CoreServerReport {
  std::uint64_t accesses = 0, clocks = 0;
};

/// The simulated core as a device that another program uses: its registers at a socket, its memory as a file.
/// Listens at a Unix socket for one client, until it closes the connection. The file SOCKET.memory exists
/// meanwhile: 16 MiB, the addresses from 10000000 (hexadecimal) on, which the client maps. A request is three
/// words of 32 bits in the machine's order: kind, address of the register, value. Kind 0 reads, 1 writes, 2
/// waits for an interrupt. The answer is two words: value and response of AXI4-Lite. The core's time passes
/// during requests only. Throws Failure.
CoreServerReport serve_core(const CoreKey& key, MemoryTiming timing, const std::filesystem::path& socket,
                            const SimulatorFolders& folders);

}  // namespace halfway::core

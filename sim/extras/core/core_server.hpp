// SPDX-License-Identifier: Apache-2.0
// The simulated core as a device that another program uses: its registers at a socket, its memory as a file.
#pragma once

#include <cstdint>
#include <filesystem>

#include "sim/extras/core/core_simulator.hpp"

namespace halfway::core {

struct CoreServerReport {
  std::uint64_t accesses = 0, clocks = 0;
};

/// Listens at a Unix socket for one client, until it closes the connection. The file SOCKET.memory exists
/// meanwhile: 16 MiB, the addresses from 10000000 (hexadecimal) on, which the client maps. A request is three
/// words of 32 bits in the machine's order: kind, address of the register, value. Kind 0 reads, 1 writes, 2
/// waits for an interrupt. The answer is two words: value and response of AXI4-Lite. The core's time passes
/// during requests only. Throws Failure.
CoreServerReport serve_core(const CoreKey& key, MemoryTiming timing, const std::filesystem::path& socket,
                            const SimulatorFolders& folders);

}  // namespace halfway::core

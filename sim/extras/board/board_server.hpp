// SPDX-License-Identifier: Apache-2.0
// The simulated board as a device that other programs use: a socket instead of an SPI port.
#pragma once

#include <cstdint>
#include <filesystem>

#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway::board {

struct ServerReport {
  std::uint64_t packets = 0, vectors = 0, clocks = 0;
  std::uint64_t pictures = 0;  ///< different ones in sequence; all are equal to the twin's
};

/// Listens at a Unix socket for one client, until it closes the connection and the monitor has shown its last
/// frame. Each transfer is a packet: the client sends the number of bytes, 32 bits in the machine's order,
/// and the bytes, and gets as many bytes back. The board's time passes during packets only. Every picture of
/// the monitor must be equal to the twin's for the packets that the board has taken; a difference is a
/// Failure with the code `differs`. Different pictures are written to out/picture-N.png.
ServerReport serve_board(const std::filesystem::path& socket, const std::filesystem::path& out,
                         const SimulatorFolders& folders);

}  // namespace halfway::board

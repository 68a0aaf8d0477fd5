// SPDX-License-Identifier: Apache-2.0
// The simulated board against its twin, which draws the same packets by the golden model: two frames of a
// scene, or the packets of another program.
#pragma once

#include <cstdint>
#include <filesystem>

#include "scene/scene.hpp"
#include "setup/setup.hpp"
#include "sim/extras/board/board_simulator.hpp"

namespace halfway::board {

/// What the host does.
enum class Host {
  steady,  ///< sends all packets as quickly as the board takes them
  /// Pauses at random, sends one packet with a wrong bit, and stops in the middle of another for longer than
  /// a picture of the monitor. It sends neither of them again: their triangles are missing.
  unreliable,
};

struct BoardCheckOptions {
  Host host = Host::steady;
  bool ghdl = false;  ///< in GHDL instead of Verilator
  SetupOptions setup{};
  double turn_degrees = 30.0;   ///< of the camera from the first frame to the second
  std::filesystem::path out{};  ///< folder for pictures
};

struct BoardReport {
  std::uint64_t packets = 0, clocks = 0;
  std::uint64_t dropped = 0;                 ///< packets that the board has refused
  std::uint64_t vectors = 0, fragments = 0;  ///< that the twin has drawn
  std::uint64_t pictures = 0;                ///< of the monitor; all are equal to the twin's
  std::uint64_t different_pictures = 0;      ///< in sequence
  /// Pixels of all frames in which 16 bits of depth choose another fragment than 24 bits, with another
  /// colour.
  std::uint64_t depth_pixels = 0;
};

/// The monitor must show a black frame, the scene, the scene from a turned camera, in this order and nothing
/// else. The status bytes must report each bad packet once, and no fault. Throws Failure, of the code
/// `differs` for a difference. Writes board-1.png and board-2.png (the monitor's), twin-1.png and twin-2.png;
/// board-different.png after a difference.
BoardReport check_board(const Scene& scene, const BoardCheckOptions& options,
                        const SimulatorFolders& folders);

/// The simulated board as a device that another program uses: a socket instead of an SPI port. Listens at a
/// Unix socket for one client, until it closes the connection and the monitor has shown its last frame. Each
/// transfer is a packet: the client sends the number of bytes, 32 bits in the machine's order, and the bytes,
/// and gets as many bytes back. The board's time passes during packets only. Every picture of the monitor
/// must be equal to the twin's for the packets that the board has taken; a difference is a Failure with the
/// code `differs`. Different pictures are written to out/picture-N.png.
BoardReport serve_board(const std::filesystem::path& socket, const std::filesystem::path& out,
                        const SimulatorFolders& folders);

}  // namespace halfway::board

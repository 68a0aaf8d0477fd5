// SPDX-License-Identifier: Apache-2.0
// Draws two frames of a scene on the simulated board, and compares every picture of the monitor with the
// twin's.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

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

struct BoardCheck {
  BoardRun run;
  std::uint64_t vectors = 0, fragments = 0;  ///< of both frames, as sent
  std::uint64_t pictures = 0;                ///< of the monitor; all are equal to the twin's
  /// Pixels of both frames in which 16 bits of depth choose another fragment than 24 bits, with another
  /// colour.
  std::uint64_t depth_pixels = 0;
};

/// The monitor must show a black frame, the scene, the scene from a turned camera, in this order and nothing
/// else. The status bytes must report each bad packet once, and no fault. Throws Failure, of the code
/// `differs` for a difference. Writes board-1.png and board-2.png (the monitor's), twin-1.png and twin-2.png;
/// board-different.png after a difference.
BoardCheck check_board(const Scene& scene, const BoardCheckOptions& options, const SimulatorFolders& folders);

}  // namespace halfway::board

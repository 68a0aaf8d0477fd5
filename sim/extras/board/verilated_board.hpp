// SPDX-License-Identifier: Apache-2.0
// board_core in Verilator, with the registers in the cells of its pins, an SRAM and a monitor: the board as
// its host sees it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/extras/board/monitor.hpp"
#include "sim/extras/board/spi_wire.hpp"

namespace halfway::board {

/// Its functions throw Failure.
class VerilatedBoard {
 public:
  /// Builds the model, or takes it from the cache, and resets it. on_picture gets each picture of the
  /// monitor.
  VerilatedBoard(const SimulatorFolders& folders, std::function<void(const DotPicture&)> on_picture);
  ~VerilatedBoard();

  /// One system clock with these levels at the host's pins. Returns the level of the board's data. A fault of
  /// the bus or of the video timing has the code `differs`.
  bool clock(const SpiPins& pins);

  std::uint64_t clocks() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace halfway::board

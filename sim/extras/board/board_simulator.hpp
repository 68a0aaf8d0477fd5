// SPDX-License-Identifier: Apache-2.0
// The whole board between models of a host, an SRAM and a monitor, in Verilator or in GHDL.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "plan/hardware_key.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/extras/board/board_api.h"
#include "sim/extras/board/board_models.hpp"
#include "sim/extras/board/board_picture.hpp"
#include "sim/extras/board/spi_host.hpp"
#include "sim/os/shared_library.hpp"

namespace halfway::board {

/// The shader of rtl/board: its generics.
HardwareKey board_key();

/// board_core in Verilator, with the registers in the cells of its pins, an SRAM and a monitor: the board as
/// its host sees it. Its functions throw Failure.
class VerilatedBoard {
 public:
  /// Builds the model, or takes it from the cache, and resets it. on_picture gets each picture of the
  /// monitor.
  VerilatedBoard(const SimulatorFolders& folders, std::function<void(const DotPicture&)> on_picture);

  /// One system clock with these levels at the host's pins. Returns the level of the board's data. A fault of
  /// the bus or of the video timing has the code `differs`.
  bool clock(const SpiPins& spi);

  std::uint64_t clocks() const { return clocks_; }

 private:
  SharedLibrary library_;
  std::unique_ptr<BoardModel> core_;
  SramModel sram_{c_words_in_use};
  Monitor monitor_;
  BoardInputs inputs_{.reset = 1, .spi_select_n = 1, .spi_clock = 0, .spi_data_in = 0, .sram_data_in = 0};
  BoardOutputs outputs_{}, pins_{};  ///< of the core; of the cells, one clock later
  std::uint64_t clocks_ = 0;
};

struct BoardRun {
  HostReport report;
  bool host_done = true;     ///< all of the script is sent
  std::uint64_t clocks = 0;  ///< until the host was done
};

/// Gets each picture of the monitor; returns false to end the run. A run in GHDL ends by itself.
using OnPicture = std::function<bool(const DotPicture&)>;

/// Runs board_core in Verilator with the C++ models until on_picture returns false, or for some pictures
/// after the host is done. The host pauses at random, without a seed never. Throws Failure, of the code
/// `differs` for faults of the bus and of the video timing, and for a run without end.
BoardRun run_in_verilator(const std::vector<HostAction>& script, std::uint32_t pause_seed,
                          const SimulatorFolders& folders, const OnPicture& on_picture);

/// The same in GHDL, with the VHDL models of tb/rtl/board/board_sim_tb.vhd, until the host is done and two
/// more pictures are shown.
BoardRun run_in_ghdl(const std::vector<HostAction>& script, const SimulatorFolders& folders,
                     const OnPicture& on_picture);

}  // namespace halfway::board

// SPDX-License-Identifier: Apache-2.0
// The whole board between models of a host, an SRAM and a monitor, in Verilator or in GHDL.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/extras/board/monitor.hpp"
#include "sim/extras/board/spi_host.hpp"

namespace halfway::board {

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

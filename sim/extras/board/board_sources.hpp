// SPDX-License-Identifier: Apache-2.0
// The RTL of the board, and its generics.
#pragma once

#include <vector>

#include "plan/hardware_key.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway::board {

/// The shader of rtl/board: its generics.
HardwareKey board_key();

/// The board with its pins.
inline constexpr const char* c_board_top_file = "rtl/board/board_top.vhd";

/// The RTL in compile order, and that of the board without board_top, which needs the cells of the FPGA.
/// Throws Failure.
std::vector<VhdlSource> board_sources(const SimulatorFolders& folders);

}  // namespace halfway::board

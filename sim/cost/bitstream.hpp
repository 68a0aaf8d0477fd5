// SPDX-License-Identifier: Apache-2.0
// The board's bitstream: GHDL, Yosys, nextpnr and icepack on rtl/board/board_top.vhd and board.pcf.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "common/result.hpp"
#include "sim/cost/families.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway::synth {

inline constexpr int c_board_mhz = 50;  ///< the clock of rtl/board; nextpnr fails if the placement is slower
/// Limit of the paths from the clock's falling edge to the late clock's rising edge, three quarters of a
/// period. nextpnr reports their delay, but does not compare it with a limit.
inline constexpr double c_strobe_ns = 15.0;

/// mend_netlist for a design with cells of the vendor, for Yosys: also remove the empty modules of the cells
/// SB_*, and make texts of their parameters that GHDL prints as the bits of a text.
Result<std::string> mend_cells(std::string_view netlist);

/// What the tools report of a bitstream.
struct BoardFigures {
  Cells cells;                    ///< after Yosys
  std::uint64_t logic_cells = 0;  ///< of the HX8K, after placement
  double mhz = 0;                 ///< the clock
  double strobe_ns = 0;           ///< the longest path to the late clock
};

/// The design's netlist for Yosys, of the sources in `folders`. Throws Failure.
std::string board_netlist(const SimulatorFolders& folders);

/// Make the bitstream and write it to `output`. Throws Failure if the
/// clock is too slow or a tool is missing.
BoardFigures make_bitstream(const SimulatorFolders& folders, const std::filesystem::path& output);

}  // namespace halfway::synth

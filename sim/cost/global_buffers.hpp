// SPDX-License-Identifier: Apache-2.0
// Selects the nets for an iCE40's global buffers. nextpnr 0.4 decides by fan-out only, and would route
// enables made by lookup tables to the edge of the die.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "common/result.hpp"

namespace halfway::synth {

/// Global buffers used for enables, of the device's eight.
inline constexpr std::size_t c_enable_buffers = 4;
/// Minimum number of full sums for an enable to get a buffer: the cells of a tile.
inline constexpr std::size_t c_least_sums = 8;

/// `netlist` is Yosys's JSON. Insert an SB_GB after port clk of module `wrapped`, and one for each of at most
/// c_enable_buffers enables. An enable's buffer drives only the registers' enable pins; other loads keep the
/// original net, because a buffer that reaches enables reaches no reset. Enables with the most full sums are
/// selected, in order of name if equal. A full sum is a register after a lookup table with four inputs, with
/// I3 a carry. The local inputs of a tile are 32, all used by eight such cells. An enable fits only if it is
/// global; otherwise nextpnr routes the carries through the fabric.
Result<std::string> with_global_buffers(std::string_view netlist);

}  // namespace halfway::synth

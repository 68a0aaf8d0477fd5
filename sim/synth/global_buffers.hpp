// SPDX-License-Identifier: Apache-2.0
// Which nets take an iCE40's global buffers. nextpnr 0.4 goes by fan-out alone, and so takes enables that
// lookup tables make all the way to the die's edge.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "common/result.hpp"

namespace halfway::synth {

/// Of the device's eight global buffers, those that reach enables.
inline constexpr std::size_t kEnableBuffers = 4;
/// Full sums that an enable has to be of for a buffer: a tile's cells.
inline constexpr std::size_t kLeastSums = 8;

/// Says in hashes what with_global_buffers does, so that nothing of another rule is taken: another one
/// wherever its result changes, as a test of it asks.
inline constexpr const char* kBuffersRule = "flow 2";

/// `netlist`, JSON by Yosys, with an SB_GB between port clk of module `wrapped` and all that it goes to, and
/// one each in front of the registers of at most kEnableBuffers enables. What else such an enable goes to
/// stays as it was: a buffer that reaches enables reaches no reset. Of enables those of the most full sums
/// are chosen, of equal ones those first by name. A full sum is a register behind a lookup table of four nets
/// of which I3 is a carry: a tile has room for 32 inputs, those of eight such cells, and for an enable beside
/// them only where that is global; else nextpnr leads the carries through the fabric.
Result<std::string> with_global_buffers(std::string_view netlist);

}  // namespace halfway::synth

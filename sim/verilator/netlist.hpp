// SPDX-License-Identifier: Apache-2.0
// The Verilog netlist that `ghdl --synth` writes, mended for Verilator. GHDL 2.0.0 miscompiles some
// constructs without a message. Faults that the text shows are mended or refused here; the randomized test in
// tb/netlist/ finds the others.
#pragma once

#include <string>
#include <string_view>

#include "common/result.hpp"

namespace halfway {

/// The width of a port of module `top`; 0 where it has no such port.
unsigned port_bits(std::string_view netlist, std::string_view top, std::string_view port);

/// Mends what GHDL prints wrong and changes nothing else: quoted constants become binary numbers, bits
/// without a driver become unknown. Refuses (exit code tool_failed) what cannot be mended: any other quoted
/// string, VHDL text, a right shift of a signed value, a signed division.
Result<std::string> mend_netlist(std::string_view netlist);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// The text of the Verilog netlist that `ghdl --synth` writes, on its way to Verilator. GHDL 2.0.0 miscompiles
// some constructs in silence; what can be seen in the text is mended or refused here, the rest is left to the
// randomized test in tb/netlist/.
#pragma once

#include <string>
#include <string_view>

#include "common/result.hpp"

namespace halfway {

/// The width of a port of module `top`; 0 where it has no such port.
unsigned port_bits(std::string_view netlist, std::string_view top, std::string_view port);

/// Makes wide constants, which GHDL quotes like strings, binary numbers, and bits that nothing drives unknown
/// ones. Refuses (exit code tool_failed) a netlist that still holds a quoted string or VHDL text, a right
/// shift of a signed value, which GHDL prints as a logical one, and signed division.
Result<std::string> mend_netlist(std::string_view netlist);

/// Where wires stand that only what registers load under a condition asks for.
enum class Wires {
  outside,  ///< with the others
  inside    ///< in the process that loads, under that condition: not worked out where it does not hold
};

/// Makes registers hold by condition: `q <= load ? d : q` becomes `if (load) q <= d`, and a register of
/// several fields becomes one register a field. What the RTL says for the sake of a synthesizer's cells is
/// said more simply: a bit is not masked where it is never set, and where two conditions open a register each
/// branch knows which of them holds. The meaning is the same; Verilator leaves out what does not change.
std::string split_registers(std::string_view netlist, Wires wires = Wires::outside);

}  // namespace halfway

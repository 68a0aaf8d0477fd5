// SPDX-License-Identifier: Apache-2.0
// Repairs the Verilog netlist of `ghdl --synth` for Verilator. GHDL 2.0.0 miscompiles some constructs without
// a message. Faults that are visible in the text are repaired or refused here. The randomized test in
// tb/mutants/ finds the others.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"

namespace halfway {

struct ModulePort {
  std::string name;
  bool is_output = false;
  unsigned bits = 1;
};
/// The ports of module `top` in the netlist's order; none if the module does not exist.
std::vector<ModulePort> ports_of(std::string_view netlist, std::string_view top);
/// The width of a port of module `top`; 0 if the port does not exist.
unsigned port_bits(std::string_view netlist, std::string_view top, std::string_view port);

/// Repair GHDL's faults and change nothing else: quoted constants become binary numbers, undriven bits become
/// unknown. Refuse (exit code tool_failed) what cannot be repaired: any other quoted string, VHDL text, a
/// right shift of a signed value, a signed division.
Result<std::string> mend_netlist(std::string_view netlist);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// The parts of a netlist: each of its modules with all that it contains.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace halfway::synth {

struct NetlistPart {
  std::string module;   ///< as named by GHDL: the entity, and its generics
  std::string netlist;  ///< the modules inside it in the order of the whole, then the module
};

/// `netlist` is GHDL's Verilog. GHDL writes the modules of a part in the same order if it synthesizes the
/// part by itself. The last part is the whole netlist.
std::vector<NetlistPart> parts_of(std::string_view netlist);

}  // namespace halfway::synth

// SPDX-License-Identifier: Apache-2.0
// The text of a netlist without parts that do not describe hardware: comments, names of modules, and GHDL's
// numbers for unnamed nets.
#pragma once

#include <string>
#include <string_view>

namespace halfway::synth {

/// Remove comments and blank lines. Renumber the nets that GHDL named (n123, n123_o) by first use, and the
/// modules by position. GHDL counts all objects that it has visited and adds a hash of the generics to a
/// module's name, so both change without a change of the hardware. Netlists that differ only in these names
/// become equal. Different names stay different.
std::string nameless(std::string_view netlist);

}  // namespace halfway::synth

// SPDX-License-Identifier: Apache-2.0
// The text of a netlist without what says nothing of the hardware: comments, the names
// of modules and the numbers that GHDL gives to nets without a name.
#pragma once

#include <string>
#include <string_view>

namespace halfway::synth {

/// Removes comments and blank lines. Renumbers the nets that GHDL named itself (n123, n123_o) by their first
/// use, and the modules by their place: GHDL counts all that it has looked at, and adds a hash of the
/// generics to a module's name, so both change where no gate does. Netlists that differ in nothing else
/// become the same text. Different names stay different.
std::string nameless(std::string_view netlist);

}  // namespace halfway::synth

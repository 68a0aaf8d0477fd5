// SPDX-License-Identifier: Apache-2.0
// The text of a netlist without parts that do not describe hardware: comments and names.
#pragma once

#include <string>
#include <string_view>

namespace halfway::synth {

/// Remove comments and blank lines. Number the modules by position, and the nets, instances and ports of each
/// module by first use. The ports of the last module, the top, keep their names: a test addresses them by
/// name. Netlists that differ only in these names become equal. GHDL counts all objects that it has visited
/// and adds a hash of the generics to a module's name, so both change without a change of the hardware.
std::string nameless(std::string_view netlist);

}  // namespace halfway::synth

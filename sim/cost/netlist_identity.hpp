// SPDX-License-Identifier: Apache-2.0
// The identity of a netlist: equal hardware has the same one, in whatever it is contained.
#pragma once

#include <string>
#include <string_view>

namespace halfway::synth {

/// `netlist` is the text of mend_netlist, which has no comments. GHDL counts all objects that it has visited,
/// and adds a hash of the generics to a module's name. Both are replaced by numbers in the order of first
/// use; the result is the hash of that text.
std::string netlist_identity(std::string_view netlist);

}  // namespace halfway::synth

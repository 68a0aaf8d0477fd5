// SPDX-License-Identifier: Apache-2.0
// The identity of a netlist: equal hardware has the same one, in whatever it is contained.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace halfway::synth {

/// `netlist` is the text of mend_netlist, which has no comments. GHDL counts all objects that it has visited,
/// and adds a hash of the generics to a module's name. Both are replaced by numbers in the order of first
/// use; the result is the hash of that text.
std::string netlist_identity(std::string_view netlist);

/// The identities of the netlist's modules, each with all modules inside it: those that they have if they are
/// synthesized by themselves.
std::set<std::string> part_identities(std::string_view netlist);

}  // namespace halfway::synth

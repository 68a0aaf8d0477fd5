// SPDX-License-Identifier: Apache-2.0
// A hardware key's netlist, as Verilator is given it.
#pragma once

#include <string>

#include "common/result.hpp"
#include "plan/hardware_key.hpp"
#include "sim/ghdl/ghdl_library.hpp"
#include "sim/verilator/netlist.hpp"

namespace halfway {

/// The mended netlist of a key, cached by what it is made from: synthesis takes longer than all else when
/// nothing changed.
Result<std::string> netlist_of(const HardwareKey& key, const SimulatorFolders& folders,
                               Wires wires = Wires::outside);

}  // namespace halfway

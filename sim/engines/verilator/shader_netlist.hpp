// SPDX-License-Identifier: Apache-2.0
// The netlist of a hardware key for Verilator and lanes.
#pragma once

#include <string>

#include "plan/hardware_key.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway {

/// The RTL, for synthesis.
GhdlLibrary rtl_library(const SimulatorFolders& folders);

/// The repaired netlist of a key. GHDL's output is cached by its inputs, because synthesis takes longer than
/// all other steps of an unchanged build.
std::string netlist_of(const HardwareKey& key, const SimulatorFolders& folders);

}  // namespace halfway

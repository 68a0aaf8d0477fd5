// SPDX-License-Identifier: Apache-2.0
// How many of each entity a hardware key elaborates.
#pragma once

#include <map>
#include <string>

#include "plan/hardware_key.hpp"

namespace halfway {

/// Entities by name, the top left out. Checked against the netlist by hardware_units_test.cpp.
std::map<std::string, int> hardware_units(const HardwareKey& key);

/// What is in `to` and not in `from`.
std::map<std::string, int> units_added(const HardwareKey& from, const HardwareKey& to);

/// Of these, what every key has: the depth's, and what the spherical shader and the processors have for
/// ambient light.
std::map<std::string, int> depth_units(const HardwareKey& key);
std::map<std::string, int> ambient_units(const HardwareKey& key);
/// What raises cosines to a material's exponent, in the shading processors.
std::map<std::string, int> power_units(const HardwareKey& key);

}  // namespace halfway

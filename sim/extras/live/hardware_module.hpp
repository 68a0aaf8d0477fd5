// SPDX-License-Identifier: Apache-2.0
// A shader's RTL as a WebAssembly module: the generated text of lanes, compiled for a browser.
#pragma once

#include <filesystem>

#include "plan/hardware_key.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway {

/// The module's file in build/cache/lanes/, built unless it exists. hardware_harness.cpp lists its functions.
std::filesystem::path build_hardware_module(const HardwareKey& key, const SimulatorFolders& folders);

}  // namespace halfway

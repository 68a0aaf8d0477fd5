// SPDX-License-Identifier: Apache-2.0
// The core of the page as a WebAssembly module: the core of model/ and LiveFrame, compiled for a browser.
#pragma once

#include <filesystem>

#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway {

/// The module's file in build/cache/live/core-<hash>/, compiled unless it exists.
/// live_core/module_exports.cpp lists its functions.
std::filesystem::path build_core_module(const SimulatorFolders& folders);

}  // namespace halfway

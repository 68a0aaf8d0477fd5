// SPDX-License-Identifier: Apache-2.0
// The checkout and its cache, for tests that simulate.
#pragma once

#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/os/test/source_folder.hpp"

namespace halfway {

inline const SimulatorFolders c_checkout{c_source_folder, c_source_folder / "build" / "cache"};

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// Setups and golden models with word lengths that are not compiled into the program. The same sources are
// compiled with other formats into a shared library, which is cached.
#pragma once

#include "plan/hardware_key.hpp"
#include "sim/driver/models.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway {

/// The models of the key's shader, preset and word lengths, for keys with these. Opens their library; if it
/// is not in the cache, compiles it with the program's own compiler. Returns bad input if the program was
/// built from other sources than the checkout's. A setup or golden model must not outlive the models.
Models made_models(const HardwareKey& key, const SimulatorFolders& folders);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// For a program without extras.
#include "sim/run/open_engine.hpp"

namespace halfway {

Result<std::shared_ptr<Engine>> open_lanes(const HardwareKey&, const SimulatorFolders&,
                                           const EngineOptions&) {
  return tool_failed("lanes: this program is built without them; configure it with -DHALFWAY_EXTRAS=ON");
}

}  // namespace halfway

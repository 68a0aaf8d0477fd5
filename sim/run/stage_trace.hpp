// SPDX-License-Identifier: Apache-2.0
// The stages of a shader's RTL, simulated in GHDL.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plan/hardware_key.hpp"
#include "sim/driver/shader_stages.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/files/init_file.hpp"

namespace halfway {

/// Result of a simulation in GHDL.
struct StageTrace {
  std::vector<std::vector<RtlEvent>> events;  ///< one list per stage
  std::string fault;  ///< fault reported by the hardware through the testbench; empty: none
};

/// Simulate the vectors of whole triangles in GHDL. `fragments`: number of fragments in the golden model.
StageTrace trace_stages(const HardwareKey& key, const ShaderStages& stages, const SimulatorFolders& folders,
                        const InitStream& vectors, std::uint64_t fragments);

}  // namespace halfway

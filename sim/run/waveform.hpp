// SPDX-License-Identifier: Apache-2.0
// A short waveform around the first fragment that differs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "plan/hardware_key.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/run/result_files.hpp"

namespace halfway {

/// Cycles shown before and after the fragment.
inline constexpr std::uint64_t c_waveform_before = 200, c_waveform_after = 100;

/// Draws again and writes <folder>/mismatch-<simulator>.fst around fragment `index` of the stream, or around
/// the start of the run if there is no index. Verilator starts c_waveform_before cycles before the fragment.
/// GHDL cannot start in the middle, so it gets only the init vectors of the triangles around the fragment.
std::filesystem::path write_mismatch_waveform(const HardwareKey& key, const SimulatorFolders& folders,
                                              const ResultFiles& files, const std::string& simulator,
                                              std::optional<std::uint64_t> index, std::uint32_t stall_seed);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// Savings in hardware for unused effects: the scenes of the two tables of docs/effects.md, the measured costs
// as a file, and the tables.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/result.hpp"
#include "frame/frame.hpp"
#include "plan/plan.hpp"
#include "sim/costs/cells.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway {

inline constexpr const char* c_savings =
    "docs/results/gallery/savings.csv";  ///< relative to the project's root

struct SavingsCase {
  const char* scene;  ///< a built-in scene
  const char* what;   ///< description of the scene in docs/effects.md
  Shader shader;
  Preset preset;

  PlanRequest request() const { return {.shader = shader, .preset = preset}; }
  FrameSize size() const;
};
std::span<const SavingsCase> savings_cases();

/// Cost of one hardware.
struct HardwareCost {
  std::string key;
  std::uint64_t luts = 0, flip_flops = 0, memory_bits = 0, multipliers = 0;  ///< as in CellCounter
  std::uint64_t cycles = 0;                                                  ///< for the frame
};
struct Savings {
  HardwareCost called_for, everything;
};

/// Measure every case; this takes minutes on all cores. `on_line` receives each line of the file as soon as
/// it is measured.
Result<std::vector<Savings>> measure_savings(const SimulatorFolders& folders, unsigned threads,
                                             const std::function<void(const std::string&)>& on_line);

/// One line per hardware, in the order of the cases.
std::string to_csv(std::span<const Savings> savings);
/// An error if the file has other cases.
Result<std::vector<Savings>> read_savings(const std::filesystem::path& csv);

/// The page with its parts "savings" and "savings of processors" written from these costs.
Result<std::string> with_savings(const std::string& readme, std::span<const Savings> savings);

}  // namespace halfway

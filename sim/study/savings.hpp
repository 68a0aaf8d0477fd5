// SPDX-License-Identifier: Apache-2.0
// Savings in hardware for unused effects: the two tables of docs/effects.md.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "plan/plan.hpp"
#include "sim/cost/synthesis.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway {

struct SavingsCase {
  const char* scene;  ///< a built-in scene
  const char* what;   ///< description of the scene in docs/effects.md
  Shader shader;
  Preset preset;
};
std::span<const SavingsCase> savings_cases();

/// Cost of one hardware: its generic cells, and the cycles for the frame.
struct HardwareCost : Cells {
  std::uint64_t cycles = 0;
};
struct Savings {
  HardwareCost called_for, everything;
};

/// Measure every case; this takes minutes on all cores. `on_line` receives a line for each hardware.
std::vector<Savings> measure_savings(const SimulatorFolders& folders, unsigned threads,
                                     const std::function<void(const std::string&)>& on_line);

/// The page with its parts "savings" and "savings of processors" written from these costs.
std::string with_savings(const std::string& page, std::span<const Savings> savings);

}  // namespace halfway

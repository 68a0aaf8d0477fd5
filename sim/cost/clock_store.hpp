// SPDX-License-Identifier: Apache-2.0
// The measured clocks that are kept in the checkout: docs/results/clocks.csv, written by
// `make evidence PAGE=clocks`.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "sim/cost/synthesis.hpp"

namespace halfway::synth {

/// Relative to the project's root.
inline constexpr const char* c_clocks = "docs/results/clocks.csv";

struct StoredClock {
  Ice40Cells cells;
  double mhz = 0;                  ///< median of the placements; 0: the hardware is not placed
  unsigned seeds = 0;              ///< number of placements
  std::string tools{}, netlist{};  ///< Synthesizer::versions, netlist_identity
};
/// By the name of the design, or of the hardware key.
using ClockStore = std::map<std::string, StoredClock>;

/// Empty if there is no file.
Result<ClockStore> read_clocks(const std::filesystem::path& root);
Status write_clocks(const std::filesystem::path& root, const ClockStore& clocks);

}  // namespace halfway::synth

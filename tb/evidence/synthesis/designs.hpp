// SPDX-License-Identifier: Apache-2.0
// The designs of `make synth`: shaders, every entity, and limits for comparison. designs_test.cpp compares
// the list with rtl/.
#pragma once

#include <filesystem>
#include <vector>

#include "measure.hpp"
#include "sim/cost/design.hpp"

namespace halfway::synth {

inline constexpr const char* c_accumulator = "tb/evidence/synthesis/accumulator.vhd";  ///< not in rtl/

struct ListedDesign {
  Design design;       ///< its name in pages and thresholds
  bool quick = false;  ///< one or two seconds of Yosys: also in `make test`
  bool ice40 = true;   ///< false: much too large for the device and slow to synthesize; only for ECP5
  bool ecp5 = false;   ///< its clock on the ECP5 is stored, and has a threshold
  unsigned seeds = 0;  ///< of the placement on the ECP5; 0: as stored, or c_seeds
};

/// All designs, in the order of the page. `root`: the project's.
std::vector<ListedDesign> all_designs(const std::filesystem::path& root);

/// Those of them that the options select, at least one. Throws Failure.
std::vector<ListedDesign> selected(const Options& options);

/// The name, as code in Markdown.
std::string quoted(const Design& design);

}  // namespace halfway::synth

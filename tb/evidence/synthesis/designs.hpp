// SPDX-License-Identifier: Apache-2.0
// The designs of `make synth`: shaders, every entity, and limits for comparison. designs_test.cpp compares
// the list with rtl/.
#pragma once

#include <string>
#include <vector>

#include "sim/cost/synthesis.hpp"

namespace halfway::synth {

inline constexpr const char* c_accumulator = "tb/evidence/synthesis/accumulator.vhd";  ///< not in rtl/

struct ListedDesign {
  Design design;       ///< its name in pages and thresholds
  bool quick = false;  ///< one or two seconds of Yosys: also in `make test`
  bool ice40 = true;  ///< false: much too large for the device and slow to synthesize; only for ECP5, without
                      ///< thresholds
};

/// All designs, in the order of the page.
std::vector<ListedDesign> all_designs();

}  // namespace halfway::synth

// SPDX-License-Identifier: Apache-2.0
// What `make synth` synthesizes: shaders, every entity, and what bounds them. designs_test.cpp holds the list
// against rtl/.
#pragma once

#include <string>
#include <vector>

#include "sim/synth/synthesis.hpp"

namespace halfway::synth {

inline constexpr const char* kAccumulator = "tb/synth/accumulator.vhd";  ///< beside rtl/

struct ListedDesign {
  Design design;       ///< its name in the page and in the file of pinned figures
  bool quick = false;  ///< a second or two of Yosys: in `make test` too
  bool ice40 = true;   ///< false: far past the device, and long in the making; for ECP5 alone, and not pinned
};

/// All of them, in the order of the page.
std::vector<ListedDesign> all_designs();

}  // namespace halfway::synth

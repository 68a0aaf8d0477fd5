// SPDX-License-Identifier: Apache-2.0
// For tests: whether the stored clocks are those of the installed GHDL's netlists.
#pragma once

#include <algorithm>
#include <string>

#include "sim/cost/clock_store.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/os/must.hpp"

namespace halfway::synth {

/// Clocks are placed with the tools of one Debian release. A GHDL of another release writes other netlists,
/// which have no stored clock.
inline bool are_of_this_ghdl(const ClockStore& clocks) {
  const std::string version = must(GhdlTool::find()).version, number = version.substr(0, version.find(" ("));
  return std::ranges::any_of(clocks,
                             [&](const auto& clock) { return clock.second.tools.starts_with(number + ","); });
}

}  // namespace halfway::synth

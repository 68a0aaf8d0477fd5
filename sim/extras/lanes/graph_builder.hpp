// SPDX-License-Identifier: Apache-2.0
// Phase 3 of the lane generator: builds the graph of one clock from a netlist's expressions.
#pragma once

#include "sim/extras/lanes/cell_layout.hpp"
#include "sim/extras/lanes/lane_generator.hpp"
#include "sim/extras/lanes/netlist_reader.hpp"
#include "sim/extras/lanes/step.hpp"

namespace halfway {

/// The step with `reset` 0 or 1, with registers cut as in `layout`. Additional cuts that are needed are noted
/// in `layout`; if it changes, build again. Throws Failure.
Step build_step(const LaneNetlist& netlist, const LanePorts& ports, bool reset, CellLayout& layout);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// Phase 6 of the lane generator: the C++ of the scheduled steps.
#pragma once

#include <string>

#include "sim/extras/lanes/cell_layout.hpp"
#include "sim/extras/lanes/netlist_reader.hpp"
#include "sim/extras/lanes/register_names.hpp"
#include "sim/extras/lanes/schedule.hpp"

namespace halfway {

/// One of step() and reset_step().
struct ScheduledStep {
  Step step;
  Schedule schedule;
};

/// What both functions share.
struct EmittedHardware {
  const LaneNetlist& netlist;
  const RegisterNames& names;
  const MemoryWords& memory_words;
  const CellSet& live;
  const Delays& delays;
};

std::string emit_lanes(const EmittedHardware& hardware, const ScheduledStep& step,
                       const ScheduledStep& reset_step);

}  // namespace halfway

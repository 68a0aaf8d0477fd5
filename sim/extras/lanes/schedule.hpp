// SPDX-License-Identifier: Apache-2.0
// Phase 5 of the lane generator: the order of the updates in a clock.
// Updates with the same condition form a group, which runs only if some lane needs it. Within a span, for
// example, only the updates of a step along the span run. A group that reads a register precedes a group that
// writes it; if no such order exists, the old value is saved.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "sim/extras/lanes/cell_layout.hpp"
#include "sim/extras/lanes/step.hpp"

namespace halfway {

/// Cells and banks that a group reads and writes share one numbering: banks start here.
constexpr std::size_t c_first_bank = std::size_t{1} << 32;

/// Cells and banks.
using CellSet = std::set<std::size_t>;

/// Registers that only delay another one are not moved: the values of `head` are kept in a ring, one place
/// per clock, and a delay of `age` clocks reads an older place. Registers that move under the same condition,
/// such as the stages of a pipeline, share a ring.
struct Delay {
  std::size_t ring, head;
  unsigned age;
};
using Delays = std::map<std::size_t, Delay>;      ///< by cell
constexpr unsigned c_ring_places = 8;             ///< a power of two
constexpr unsigned c_oldest = c_ring_places - 2;  ///< the next older place is the one being written

struct Group {
  Guard guard;
  int condition;  ///< the guard as one mask
  std::vector<Update> updates{};
  std::map<std::size_t, Store> banks{};  ///< new values of their places
  CellSet reads{}, writes{};
};

struct Schedule {
  std::vector<bool> always;   ///< nodes calculated in every clock, for outputs and conditions
  std::vector<int> rings;     ///< masks of the lanes in which each ring moves
  std::vector<Group> groups;  ///< in order
  CellSet saved;              ///< cells whose old values are saved before all groups
};

/// The cells and banks that the outputs and the observed parts depend on, over any number of clocks.
CellSet live_cells(const Step& step, const MemoryWords& memory_words);

Delays find_delays(const Step& step, const Step& reset_step, const CellSet& live);

/// Memories that read from one another at the same edge have no order: a Failure (exit code tool_failed).
Schedule make_schedule(Step& step, const MemoryWords& memory_words, const CellSet& live,
                       const Delays& delays);

/// The mask of the lanes that change and the new value; -1 and the value if all change.
std::pair<int, int> changed_lanes(const Step& step, const Delays& delays, const Update& update);

/// Mark a node and all nodes that it depends on, and collect the cells and banks among them.
void mark_used(const LaneGraph& graph, int node, std::vector<bool>& used, CellSet& cells);

}  // namespace halfway

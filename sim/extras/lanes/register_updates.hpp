// SPDX-License-Identifier: Apache-2.0
// Phase 4 of the lane generator: turns "the register keeps its value" into a condition.
// GHDL prints a register with an enable as one that is loaded in every clock: `q <= enable ? d : q`. Here it
// becomes `if enable: q <= d`, so that the generated text skips the assignment and its calculation while no
// lane needs it.
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "sim/extras/lanes/bit_operations.hpp"
#include "sim/extras/lanes/step.hpp"

namespace halfway {

/// Simplifies values of the graph under a guard that is known to be true.
class KnownConditions {
 public:
  explicit KnownConditions(LaneGraph& graph) : graph_(graph) {}

  /// The same value with each mask of the guard replaced by a constant.
  int simplify(int node, const Guard& guard);

  /// True if `bit` is 0 whenever `mask` is false, because its operand then has too few bits. `bit & mask` is
  /// `bit` in this case.
  bool implies(int bit, int mask);

 private:
  int simplify(int node, const Guard& guard, std::map<int, int>& known);
  LaneGraph& graph_;
  std::map<Guard, std::map<int, int>> known_;
};

/// Values loaded into a cell and their conditions.
using Loads = std::vector<std::pair<Guard, Bits>>;

/// The loads of the cell, if its next value under `guard` is `next`.
Loads loads_of(Step& step, BitOperations& operations, KnownConditions& conditions, std::size_t cell,
               const Bits& next, const Guard& guard);

}  // namespace halfway

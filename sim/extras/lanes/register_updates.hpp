// SPDX-License-Identifier: Apache-2.0
// Phase 4 of the lane generator: turns "the register keeps its value" into a condition.
// GHDL prints a register with an enable as one that is loaded in every clock: `q <= enable ? d : q`. Here it
// becomes `if enable: q <= d`, so that the generated text skips the assignment and its calculation while no
// lane needs it.
#pragma once

#include <map>
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

class RegisterUpdates {
 public:
  RegisterUpdates(Step& step, BitOperations& operations, KnownConditions& conditions)
      : step_(step), operations_(operations), conditions_(conditions) {}

  using Loads = std::vector<std::pair<Guard, Bits>>;

  /// The values loaded into the cell and their conditions, if its next value under `guard` is `next`.
  Loads loads_of(std::size_t cell, const Bits& next, const Guard& guard);

 private:
  bool split(std::size_t cell, const Bits& next, const Guard& guard, Loads& loads, int depth);
  Bits simplify(const Bits& bits, const Guard& guard);
  bool is_cell(const Bits& bits, std::size_t cell) const;
  bool can_be_cell(int node, unsigned low, std::size_t cell) const;
  int holding_condition(const Bits& bits, std::size_t cell) const;
  int first_condition(int condition, const Bits& bits, const Guard& guard);
  bool chooses_by(int node, int mask) const;

  LaneGraph& graph() const { return step_.graph; }
  Step& step_;
  BitOperations& operations_;
  KnownConditions& conditions_;
};

}  // namespace halfway

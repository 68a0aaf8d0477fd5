// SPDX-License-Identifier: Apache-2.0
// Phase 4 of the lane generator: turns what a register keeps into a condition.
//
// GHDL prints a register with an enable as one that is loaded in every clock: `q <= enable ? d : q`. Here it
// becomes `if enable: q <= d`, so that the generated text skips the assignment, and all that is calculated
// for it, while no lane needs it.
#pragma once

#include <map>
#include <vector>

#include "sim/lanes/bit_operations.hpp"
#include "sim/lanes/step.hpp"

namespace halfway {

/// Values of the graph where a guard is known to hold.
class KnownConditions {
 public:
  explicit KnownConditions(LaneGraph& graph) : graph_(graph) {}

  /// The same value with each mask of the guard replaced by a constant.
  int simplify(int node, const Guard& guard);

  /// Whether `bit` is never set while `mask` is false, so that `bit & mask` is `bit`: its number is too small
  /// then.
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

  /// What is loaded into the cell and when, if under `guard` its next value is `next`.
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

// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/lanes/register_updates.hpp"

#include <algorithm>
#include <array>

namespace halfway {
namespace {

constexpr int c_deepest_choice = 6;  ///< conditions on the way to a value; deeper ones are not split

/// The loads of one cell.
class CellLoads {
 public:
  CellLoads(Step& step, BitOperations& operations, KnownConditions& conditions, std::size_t cell)
      : graph_(step.graph), operations_(operations), conditions_(conditions), cell_(cell) {}

  /// Add the values loaded into the cell under `guard` to `loads`. Return true if the cell keeps its value in
  /// some case.
  bool split(const Bits& next, const Guard& guard, Loads& loads, int depth) {
    const Bits bits = simplify(next, guard);
    if (is_cell(bits)) return true;

    // Split by a condition under which the cell may keep its value.
    if (int mask = holding_condition(bits); mask >= 0 && depth < c_deepest_choice) {
      mask = first_condition(mask, bits, guard);
      Loads inner;
      bool holds = false;
      for (const bool wanted : {true, false})
        if (const auto narrower = narrow(graph_, guard, mask, wanted))
          holds |= split(bits, *narrower, inner, depth + 1);
      if (holds) {
        loads.insert(loads.end(), inner.begin(), inner.end());
        return true;
      }
    }

    // The cell never keeps its value: one load suffices.
    loads.emplace_back(guard, bits);
    return false;
  }

 private:
  /// Pieces of one shifted vector become pieces of that vector, so that they join.
  Bits simplify(const Bits& bits, const Guard& guard) {
    Bits result;
    for (const Piece& piece : bits) {
      const int number = conditions_.simplify(piece.node, guard);
      const LaneNode node = graph_[number];
      if (node.op == LaneOp::bit && piece.width == 1)
        operations_.append(result, {node.operands[0], static_cast<unsigned>(node.value), 1});
      else if (node.op == LaneOp::right)
        operations_.append(result,
                           {node.operands[0], static_cast<unsigned>(node.value) + piece.low, piece.width});
      else
        operations_.append(result, {number, piece.low, piece.width});
    }
    return result;
  }

  bool is_cell(const Bits& bits) const {
    if (bits.size() != 1 || bits[0].low != 0) return false;
    const LaneNode& node = graph_[bits[0].node];
    return (node.op == LaneOp::cell || node.op == LaneOp::mask_cell) && node.value == cell_;
  }

  /// Whether a node may be the cell shifted right by `low`.
  bool can_be_cell(int number, unsigned low) const {
    const LaneNode& node = graph_[number];
    if (node.op == LaneOp::cell || node.op == LaneOp::mask_cell) return node.value == cell_ && low == 0;
    if (node.op == LaneOp::bit || node.op == LaneOp::right)
      return node.value == low && can_be_cell(node.operands[0], 0);
    return node.op == LaneOp::select &&
           (can_be_cell(node.operands[1], low) || can_be_cell(node.operands[2], low));
  }

  /// The condition of a choice between another value and the cell itself; -1: none.
  int holding_condition(const Bits& bits) const {
    unsigned at = 0;
    for (const Piece& piece : bits) {
      const LaneNode& node = graph_[piece.node];
      if (node.op == LaneOp::select && piece.low <= at &&
          can_be_cell(piece.node, node.mask ? at : at - piece.low))
        return node.operands[0];
      at += piece.width;
    }
    return -1;
  }

  /// If the condition is `a | b`, and the value depends on a, split by b first: `(a | b) ? (a ? x : y) : q`
  /// becomes `b ? (a ? x : y) : (a ? x : q)`. A load (a) is rarer than a step (b), and skipped in most
  /// clocks.
  int first_condition(int condition, const Bits& bits, const Guard& guard) {
    const LaneNode node = graph_[condition];
    if (node.op != LaneOp::either) return condition;
    const auto narrower = narrow(graph_, guard, condition, true);
    if (!narrower) return condition;
    for (const Piece& piece : simplify(bits, *narrower)) {
      if (chooses_by(piece.node, node.operands[0])) return node.operands[1];
      if (chooses_by(piece.node, node.operands[1])) return node.operands[0];
    }
    return condition;
  }

  /// Whether a node is `mask ? x : y`, or `x & ~mask`.
  bool chooses_by(int number, int mask) const {
    const LaneNode& node = graph_[number];
    if (node.op == LaneOp::select) return node.operands[0] == mask;
    if (node.op != LaneOp::both) return false;
    return std::any_of(node.operands.begin(), node.operands.begin() + 2, [&](int operand) {
      const LaneNode& inverse = graph_[operand];
      return inverse.op == LaneOp::invert && inverse.operands[0] == mask;
    });
  }

  LaneGraph& graph_;
  BitOperations& operations_;
  KnownConditions& conditions_;
  std::size_t cell_;
};

}  // namespace

int KnownConditions::simplify(int node, const Guard& guard) {
  return guard.empty() ? node : simplify(node, guard, known_[guard]);
}

int KnownConditions::simplify(int number, const Guard& guard, std::map<int, int>& known) {
  if (const auto found = known.find(number); found != known.end()) return found->second;
  const LaneNode node = graph_[number];
  int result = number;
  if (node.mask && guard.count({number, true}) != 0) {
    result = graph_.mask_constant(true);
  } else if (node.mask && guard.count({number, false}) != 0) {
    result = graph_.mask_constant(false);
  } else {
    std::array<int, 3> operands{-1, -1, -1};
    for (std::size_t i = 0; i < 3 && node.operands[i] >= 0; ++i)
      operands[i] = simplify(node.operands[i], guard, known);
    if (operands != node.operands) result = graph_.with_operands(node, operands);
  }
  return known[number] = result;
}

bool KnownConditions::implies(int bit, int mask) {
  const LaneNode node = graph_[bit];
  if (node.op != LaneOp::bit) return false;
  const auto guard = narrow(graph_, {}, mask, false);
  return guard && graph_[simplify(node.operands[0], *guard)].bits <= node.value;
}

Loads loads_of(Step& step, BitOperations& operations, KnownConditions& conditions, std::size_t cell,
               const Bits& next, const Guard& guard) {
  Loads loads;
  CellLoads(step, operations, conditions, cell).split(next, guard, loads, 0);
  return loads;
}

}  // namespace halfway

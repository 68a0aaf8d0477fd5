// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/lanes/step.hpp"

#include <algorithm>

namespace halfway {

unsigned width_of(const Bits& bits) {
  unsigned width = 0;
  for (const Piece& piece : bits) width += piece.width;
  return width;
}

bool implies_operands(const LaneNode& mask, bool wanted) {
  return mask.op == (wanted ? LaneOp::both : LaneOp::either);
}

std::optional<Guard> narrow(const LaneGraph& graph, Guard guard, int mask, bool wanted) {
  const LaneNode node = graph[mask];
  if (node.op == LaneOp::mask_constant)
    return (node.value != 0) == wanted ? std::optional(std::move(guard)) : std::nullopt;
  if (node.op == LaneOp::invert) return narrow(graph, std::move(guard), node.operands[0], !wanted);
  if (guard.count({mask, !wanted}) != 0) return std::nullopt;
  guard.insert({mask, wanted});
  if (!implies_operands(node, wanted)) return guard;
  auto narrower = narrow(graph, std::move(guard), node.operands[0], wanted);
  return narrower ? narrow(graph, std::move(*narrower), node.operands[1], wanted) : std::nullopt;
}

bool excludes(const Guard& a, const Guard& b) {
  return std::any_of(a.begin(), a.end(),
                     [&](const auto& literal) { return b.count({literal.first, !literal.second}) != 0; });
}

}  // namespace halfway

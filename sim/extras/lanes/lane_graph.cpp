// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/lanes/lane_graph.hpp"

#include <bit>
#include <utility>

namespace halfway {

int LaneGraph::add(LaneNode node) {
  const auto [at, fresh] = known_.try_emplace({node.op, node.operands, node.value}, size());
  if (fresh) nodes_.push_back(node);
  return at->second;
}

int LaneGraph::constant(std::uint64_t value) {
  return add({.op = LaneOp::constant, .value = value, .bits = static_cast<unsigned>(std::bit_width(value))});
}

int LaneGraph::operate(LaneOp op, int a, int b) {
  const LaneNode &x = (*this)[a], &y = (*this)[b];
  if (x.mask) return operate_masks(op, a, b);
  unsigned bits = c_lane_word;
  switch (op) {
    case LaneOp::add:
      bits = std::min(c_lane_word, std::max(x.bits, y.bits) + 1);
      break;
    case LaneOp::multiply:
      bits = x.bits == 0 || y.bits == 0 ? 0 : std::min(c_lane_word, x.bits + y.bits);
      break;
    case LaneOp::multiply_high:
      bits = std::max(c_lane_word, x.bits + y.bits) - c_lane_word;
      break;
    case LaneOp::both:
      bits = std::min(x.bits, y.bits);
      break;
    case LaneOp::either:
    case LaneOp::differ:
      bits = std::max(x.bits, y.bits);
      break;
    case LaneOp::right_by:
      bits = x.bits;
      break;
    default:
      break;
  }
  const bool commutes = op == LaneOp::add || op == LaneOp::multiply || op == LaneOp::multiply_high ||
                        op == LaneOp::signed_multiply_high || op == LaneOp::both || op == LaneOp::either ||
                        op == LaneOp::differ;
  if (commutes && a > b) std::swap(a, b);
  if (bits == 0) return constant(0);
  if ((op == LaneOp::add || op == LaneOp::either) && (*this)[a].bits == 0) return b;
  if ((op == LaneOp::add || op == LaneOp::either || op == LaneOp::subtract) && (*this)[b].bits == 0) return a;
  return add({.op = op, .operands = {a, b, -1}, .bits = bits});
}

int LaneGraph::invert(int a) {
  const LaneNode& x = (*this)[a];
  if (x.op == LaneOp::mask_constant) return mask_constant(x.value == 0);
  if (x.op == LaneOp::invert) return x.operands[0];
  return add({.op = LaneOp::invert, .operands = {a, -1, -1}, .mask = x.mask});
}

int LaneGraph::shift(int a, int by) {
  const LaneNode& x = (*this)[a];
  if (by == 0 || x.bits == 0) return a;
  const auto distance = static_cast<unsigned>(std::abs(by));
  if (x.op == LaneOp::constant)
    return constant(by > 0 ? x.value << distance & low_ones(c_lane_word) : x.value >> distance);
  if (by < 0 && x.bits <= distance) return constant(0);
  return add({.op = by > 0 ? LaneOp::left : LaneOp::right,
              .operands = {a, -1, -1},
              .value = distance,
              .bits = by > 0 ? std::min(c_lane_word, x.bits + distance) : x.bits - distance});
}

int LaneGraph::clean(int a, unsigned width) {
  const LaneNode& x = (*this)[a];
  if (x.bits <= width) return a;
  if (x.op == LaneOp::constant) return constant(x.value & low_ones(width));
  return operate(LaneOp::both, a, constant(low_ones(width)));
}

int LaneGraph::select(int mask, int a, int b) {
  const LaneNode &m = (*this)[mask], &x = (*this)[a], &y = (*this)[b];
  if (m.op == LaneOp::mask_constant) return m.value != 0 ? a : b;
  if (m.op == LaneOp::invert) return select(m.operands[0], b, a);
  if (a == b) return a;
  if (x.op == LaneOp::mask_constant)
    return x.value != 0 ? operate(LaneOp::either, mask, b) : operate(LaneOp::both, invert(mask), b);
  if (y.op == LaneOp::mask_constant)
    return y.value != 0 ? operate(LaneOp::either, invert(mask), a) : operate(LaneOp::both, mask, a);
  return add(
      {.op = LaneOp::select, .operands = {mask, a, b}, .bits = std::max(x.bits, y.bits), .mask = x.mask});
}

int LaneGraph::fill(int mask, std::uint64_t value) {
  const LaneNode& m = (*this)[mask];
  if (m.op == LaneOp::mask_constant) return constant(m.value != 0 ? value : 0);
  return add({.op = LaneOp::fill,
              .operands = {mask, -1, -1},
              .value = value,
              .bits = static_cast<unsigned>(std::bit_width(value))});
}

int LaneGraph::rom(std::size_t table, int address, unsigned bits) {
  return add({.op = LaneOp::rom, .operands = {address, -1, -1}, .value = table, .bits = bits});
}

int LaneGraph::operate_masks(LaneOp op, int a, int b) {
  if (a > b) std::swap(a, b);
  for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)}) {
    const LaneNode& x = (*this)[one];
    if (x.op == LaneOp::mask_constant) {
      if (op == LaneOp::differ) return x.value != 0 ? invert(other) : other;
      return (x.value != 0) == (op == LaneOp::both) ? other : one;
    }
    if (x.op == LaneOp::invert && x.operands[0] == other) return mask_constant(op != LaneOp::both);
  }
  if (a == b) return op == LaneOp::differ ? mask_constant(false) : a;
  return add({.op = op, .operands = {a, b, -1}, .mask = true});
}

int LaneGraph::bit(int a, unsigned index) {
  const LaneNode& x = (*this)[a];
  if (x.bits <= index) return mask_constant(false);
  if (x.op == LaneOp::constant) return mask_constant((x.value >> index & 1) != 0);
  return add({.op = LaneOp::bit, .operands = {a, -1, -1}, .value = index, .mask = true});
}

int LaneGraph::compare(LaneOp op, int a, int b) {
  if (a == b) return mask_constant(op == LaneOp::equal);
  const LaneNode &x = (*this)[a], &y = (*this)[b];
  if (x.op == LaneOp::constant && y.op == LaneOp::constant) {
    const auto p = static_cast<std::int32_t>(x.value), q = static_cast<std::int32_t>(y.value);
    return mask_constant(op == LaneOp::equal ? p == q : op == LaneOp::less ? x.value < y.value : p < q);
  }
  // Processors without AVX-512 compare signed numbers only.
  if (op == LaneOp::less && y.bits == 0) return mask_constant(false);
  if (op == LaneOp::less && x.bits < c_lane_word && y.bits < c_lane_word) op = LaneOp::signed_less;
  if (op == LaneOp::equal && a > b) std::swap(a, b);
  return add({.op = op, .operands = {a, b, -1}, .mask = true});
}

int LaneGraph::with_operands(const LaneNode& node, const std::array<int, 3>& x) {
  if (node.op >= LaneOp::add && node.op <= LaneOp::differ) return operate(node.op, x[0], x[1]);
  if (node.op >= LaneOp::equal) return compare(node.op, x[0], x[1]);
  switch (node.op) {
    case LaneOp::invert:
      return invert(x[0]);
    case LaneOp::select:
      return select(x[0], x[1], x[2]);
    case LaneOp::left:
      return shift(x[0], static_cast<int>(node.value));
    case LaneOp::right:
      return shift(x[0], -static_cast<int>(node.value));
    case LaneOp::fill:
      return fill(x[0], node.value);
    case LaneOp::bit:
      return bit(x[0], static_cast<unsigned>(node.value));
    default:
      LaneNode other = node;
      other.operands = x;
      return add(other);
  }
}

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// The values that a netlist computes per clock, as a graph of operations on lanes. Each node is a vector of
// 32-bit numbers, one per lane, or a mask of one bit per lane. Equal nodes are merged; operands precede their
// users.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

namespace halfway {

constexpr unsigned c_lane_word = 32;  ///< bits of a number in a lane

enum class LaneOp {
  // Vectors
  constant,  ///< value
  cell,      ///< a part of a register or an input: value is its number
  add,
  subtract,
  multiply,
  multiply_high,  ///< the product's upper word
  signed_multiply_high,
  both,    ///< bitwise and
  either,  ///< bitwise or
  differ,  ///< bitwise exclusive or
  invert,
  left,  ///< by a constant, `value`
  right,
  left_by,  ///< by another vector; the result is 0 from a distance of 32 on
  right_by,
  signed_right_by,
  select,  ///< mask ? a : b
  fill,    ///< mask ? value : 0
  rom,     ///< value: number of the table
  row,     ///< four words of a place: value is the bank's number
  word,    ///< of a row, by number
  // Masks
  mask_constant,
  mask_cell,
  mask_both,
  mask_either,
  mask_differ,
  mask_invert,
  mask_select,  ///< mask ? a : b, all masks
  equal,
  less,
  signed_less,
  bit,  ///< bit `value` of a vector
};

struct LaneNode {
  LaneOp op;
  std::array<int, 3> operands{-1, -1, -1};
  std::uint64_t value = 0;
  unsigned bits = c_lane_word;  ///< bits from this one up are zero

  bool is_mask() const { return op >= LaneOp::mask_constant; }
};

class LaneGraph {
 public:
  const LaneNode& operator[](int node) const { return nodes_[static_cast<std::size_t>(node)]; }
  int size() const { return static_cast<int>(nodes_.size()); }

  int constant(std::uint64_t value);
  int mask_constant(bool value) { return add({.op = LaneOp::mask_constant, .value = value}); }
  int cell(std::size_t number, unsigned bits) {
    return add({.op = LaneOp::cell, .value = number, .bits = bits});
  }
  int mask_cell(std::size_t number) { return add({.op = LaneOp::mask_cell, .value = number}); }
  int operate(LaneOp op, int a, int b);
  int invert(int a);
  int shift(int a, int by);  ///< to the left if positive
  int clean(int a, unsigned width);
  int select(int mask, int a, int b);
  int fill(int mask, std::uint64_t value);
  int rom(std::size_t table, int address, unsigned bits);
  int row(std::size_t bank, int address) {
    return add({.op = LaneOp::row, .operands = {address, -1, -1}, .value = bank});
  }
  int word(int row, std::size_t number) {
    return add({.op = LaneOp::word, .operands = {row, -1, -1}, .value = number});
  }
  int mask_operate(LaneOp op, int a, int b);
  int mask_invert(int a);
  int mask_select(int mask, int a, int b);
  int bit(int a, unsigned index);
  int compare(LaneOp op, int a, int b);
  int with_operands(const LaneNode& node, const std::array<int, 3>& operands);

 private:
  int add(LaneNode node);
  std::vector<LaneNode> nodes_;
  std::map<std::tuple<LaneOp, std::array<int, 3>, std::uint64_t>, int> known_;
};

}  // namespace halfway

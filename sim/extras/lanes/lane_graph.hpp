// SPDX-License-Identifier: Apache-2.0
// The values that a netlist computes per clock, as a graph of operations on lanes. Each node is a vector of
// 32-bit numbers, one per lane, or a mask of one bit per lane. Equal nodes are merged; operands precede their
// users.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

namespace halfway {

constexpr unsigned c_lane_word = 32;  ///< bits of a number in a lane

enum class LaneOp {
  constant,  ///< value
  cell,      ///< a part of a register or an input: value is its number
  // Operations on two vectors
  add,
  subtract,
  multiply,
  multiply_high,  ///< the product's upper word
  signed_multiply_high,
  left_by,  ///< the result is 0 from a distance of 32 on
  right_by,
  signed_right_by,
  // On two vectors or two masks
  both,    ///< bitwise and
  either,  ///< bitwise or
  differ,  ///< bitwise exclusive or
  // On vectors or masks
  invert,
  select,  ///< mask ? a : b
  // Other vectors
  left,  ///< by a constant, `value`
  right,
  fill,  ///< mask ? value : 0
  rom,   ///< value: number of the table
  row,   ///< four words of a place: value is the bank's number
  word,  ///< of a row, by number
  // Masks
  mask_constant,
  mask_cell,
  bit,  ///< bit `value` of a vector
  // Comparisons of two vectors
  equal,
  less,
  signed_less,
};

struct LaneNode {
  LaneOp op;
  std::array<int, 3> operands{-1, -1, -1};
  std::uint64_t value = 0;
  unsigned bits = c_lane_word;  ///< bits from this one up are zero
  bool mask = false;
};

/// The lowest `width` bits, at most a word, as ones.
constexpr std::uint64_t low_ones(unsigned width) {
  return (std::uint64_t{1} << std::min(width, c_lane_word)) - 1;
}

class LaneGraph {
 public:
  const LaneNode& operator[](int node) const { return nodes_[static_cast<std::size_t>(node)]; }
  int size() const { return static_cast<int>(nodes_.size()); }

  int constant(std::uint64_t value);
  int mask_constant(bool value) { return add({.op = LaneOp::mask_constant, .value = value, .mask = true}); }
  int cell(std::size_t number, unsigned bits) {
    return add({.op = LaneOp::cell, .value = number, .bits = bits});
  }
  int mask_cell(std::size_t number) { return add({.op = LaneOp::mask_cell, .value = number, .mask = true}); }
  int operate(LaneOp op, int a, int b);  ///< on two operands, but for comparisons
  int compare(LaneOp op, int a, int b);
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
  int bit(int a, unsigned index);
  int with_operands(const LaneNode& node, const std::array<int, 3>& operands);

 private:
  int add(LaneNode node);
  int operate_masks(LaneOp op, int a, int b);
  std::vector<LaneNode> nodes_;
  std::map<std::tuple<LaneOp, std::array<int, 3>, std::uint64_t>, int> known_;
};

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// Arithmetic on signals of any width, as nodes of a step's graph. Bits above a number's width are undefined
// until a comparison or a slice needs them.
#pragma once

#include <string>
#include <string_view>

#include "sim/extras/lanes/cell_layout.hpp"
#include "sim/extras/lanes/step.hpp"

namespace halfway {

class BitOperations {
 public:
  /// Notes in `layout` which parts of registers and inputs are used, and how.
  BitOperations(Step& step, CellLayout& layout) : step_(step), layout_(layout) {}

  /// Throw Failure.
  [[noreturn]] static void fail(const std::string& what);

  // Make and rearrange.
  Bits whole(int node, unsigned width) { return {{node, 0, width}}; }
  Bits constant(std::uint64_t value, unsigned width) { return whole(graph().constant(value), width); }
  Bits zeros(unsigned width);
  void append(Bits& bits, Piece piece);
  void append(Bits& bits, const Bits& more);
  Bits slice(const Bits& bits, unsigned low, unsigned width);

  // Convert. With `arithmetic` the bits are one number: no cut inside it.
  int to_vector(const Bits& bits, bool arithmetic = true);
  Words to_words(const Bits& bits, bool arithmetic = true);
  Bits from_words(const Words& words, unsigned width);
  int to_mask(const Bits& bits);
  bool is_mask(const Piece& piece) { return graph()[piece.node].mask; }
  /// The number of bits in the last word.
  static unsigned top_width(unsigned width) { return (width - 1) % c_lane_word + 1; }

  // Calculate; both operands have the same width.
  Bits choose(int mask, const Bits& a, const Bits& b);  ///< mask ? a : b
  Bits invert(const Bits& a);
  Bits add(const Bits& a, const Bits& b);
  Bits difference(const Bits& a, const Bits& b);
  Bits product(const Bits& a, const Bits& b);
  int compare(LaneOp op, const Bits& a, const Bits& b);  ///< equal, less or signed_less
  int any_bit(const Bits& a);
  /// `op`: Verilator's shiftl, shiftr or shiftrs.
  Bits shift(std::string_view op, const Bits& a, const Bits& by);

 private:
  LaneGraph& graph() { return step_.graph; }
  void note(const Piece& piece, bool arithmetic);
  void note_clean(const Piece& piece);
  std::uint64_t constant_of(const Piece& piece);
  bool is_shifted(const Bits& a, const Bits& b);
  Bits choose_words(int mask, const Bits& a, const Bits& b);
  Bits choose_pieces(int mask, const Bits& a, const Bits& b);
  int bit_of(const Bits& bits, unsigned index);
  unsigned signed_width(const Bits& bits);
  Bits sum(const Bits& a, const Bits& b, int carry);
  bool has_constant_one(const Bits& bits);
  Bits sum_with_carry(const Bits& a, const Bits& b);
  Bits shifted(std::string_view op, const Bits& a, unsigned distance);

  Step& step_;
  CellLayout& layout_;
};

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/lanes/bit_operations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "sim/os/must.hpp"

namespace halfway {
namespace {

/// The places where pieces end.
std::set<unsigned> ends_of(const Bits& bits) {
  std::set<unsigned> ends;
  unsigned at = 0;
  for (const Piece& piece : bits) ends.insert(at += piece.width);
  return ends;
}

}  // namespace

void BitOperations::fail(const std::string& what) {
  throw_tool_failed("{}", what);
}

/// The value of a piece of a constant. Bits above the node's vector are zero.
std::uint64_t BitOperations::constant_of(const Piece& piece) {
  return piece.low < c_lane_word ? graph()[piece.node].value >> piece.low & low_ones(piece.width) : 0;
}

void BitOperations::append(Bits& bits, Piece piece) {
  if (piece.width == 0) return;
  if (!bits.empty()) {
    Piece& last = bits.back();
    const LaneNode &a = graph()[last.node], &b = graph()[piece.node];
    if (last.node == piece.node && (a.mask || piece.low == last.low + last.width)) {
      last.width += piece.width;
      return;
    }
    if (a.op == LaneOp::constant && b.op == LaneOp::constant && last.width + piece.width <= c_lane_word) {
      const std::uint64_t low = constant_of(last), high = constant_of(piece);
      last = {graph().constant(low | high << last.width), 0, last.width + piece.width};
      return;
    }
  }
  bits.push_back(piece);
}

void BitOperations::append(Bits& bits, const Bits& more) {
  for (const Piece& piece : more) append(bits, piece);
}

Bits BitOperations::slice(const Bits& bits, unsigned low, unsigned width) {
  Bits found;
  unsigned at = 0;
  for (const Piece& piece : bits) {
    const unsigned begin = std::max(low, at), end = std::min(low + width, at + piece.width);
    if (begin < end) append(found, {piece.node, is_mask(piece) ? 0 : piece.low + begin - at, end - begin});
    at += piece.width;
  }
  if (width_of(found) != width) fail("a slice reaches past its signal");
  return found;
}

Bits BitOperations::zeros(unsigned width) {
  Bits bits;
  for (unsigned low = 0; low < width; low += c_lane_word)
    bits.push_back({graph().constant(0), 0, std::min(width - low, c_lane_word)});
  return bits;
}

void BitOperations::note(const Piece& piece, bool arithmetic) {
  const LaneNode& node = graph()[piece.node];
  if (node.op != LaneOp::cell) return;
  const Cell& cell = step_.cells[node.value];
  const unsigned low = cell.low + piece.low, high = low + piece.width;
  layout_.cuts[cell.signal].insert({low, high});
  if (arithmetic) layout_.uncut[cell.signal].insert({low, high});
}

/// The bits above this piece must be zero. If it is a whole cell, clean it once, when it is written, not each
/// time it is read.
void BitOperations::note_clean(const Piece& piece) {
  const LaneNode& node = graph()[piece.node];
  if (node.op != LaneOp::cell) return;
  const Cell& cell = step_.cells[node.value];
  if (cell.dirty && cell.width == piece.width) layout_.cleaned.insert({cell.signal, cell.low});
}

int BitOperations::to_vector(const Bits& bits, bool arithmetic) {
  int sum = graph().constant(0);
  std::uint64_t constants = 0;
  unsigned at = 0;
  const unsigned width = width_of(bits);
  for (const Piece& piece : bits) note(piece, arithmetic);
  // The register is not cut yet: the note above cuts it, and the graph is built again.
  if (width > c_lane_word) {
    if (layout_.words) fail(fmt::format("netlist.v: {} bits in one vector", width));
    return sum;
  }
  for (const Piece& piece : bits) {
    const std::uint64_t field = low_ones(piece.width) << at;
    const LaneNode& node = graph()[piece.node];
    if (node.mask) {
      sum = graph().operate(LaneOp::either, sum, graph().fill(piece.node, field));
    } else if (node.op == LaneOp::constant) {
      constants |= constant_of(piece) << at;
    } else {
      int part = graph().shift(piece.node, static_cast<int>(at) - static_cast<int>(piece.low));
      const bool dirty_below = piece.low > 0 && at > 0;
      const bool dirty_above = at + piece.width < width && graph()[part].bits > at + piece.width;
      if (dirty_above && piece.low == 0) note_clean(piece);
      if (dirty_below || dirty_above) part = graph().operate(LaneOp::both, part, graph().constant(field));
      sum = graph().operate(LaneOp::either, sum, part);
    }
    at += piece.width;
  }
  return graph().operate(LaneOp::either, sum, graph().constant(constants));
}

Words BitOperations::to_words(const Bits& bits, bool arithmetic) {
  Words words;
  const unsigned width = width_of(bits);
  for (const Piece& piece : bits) note(piece, arithmetic);
  for (unsigned low = 0; low < width; low += c_lane_word)
    words.push_back(to_vector(slice(bits, low, std::min(width - low, c_lane_word)), arithmetic));
  return words;
}

Bits BitOperations::from_words(const Words& words, unsigned width) {
  Bits bits;
  for (unsigned low = 0; low < width; low += c_lane_word)
    append(bits, {words[low / c_lane_word], 0, std::min(width - low, c_lane_word)});
  return bits;
}

int BitOperations::to_mask(const Bits& bits) {
  if (bits.empty()) return graph().mask_constant(false);
  const Piece& piece = bits.front();
  if (is_mask(piece)) return piece.node;
  note(piece, false);
  return graph().bit(piece.node, piece.low);
}

/// Whether `a` is `b` at another place, filled up with constants.
bool BitOperations::is_shifted(const Bits& a, const Bits& b) {
  std::map<int, unsigned> places;  // of a vector's lowest bit, modulo 2^32
  unsigned at = 0;
  for (const Piece& piece : b) {
    places.try_emplace(piece.node, at - piece.low);
    at += piece.width;
  }
  at = 0;
  bool filled = false, moved = false;
  for (const Piece& piece : a) {
    const unsigned place = at - piece.low;
    at += piece.width;
    const auto known = places.find(piece.node);
    if (graph()[piece.node].op == LaneOp::constant)
      filled = true;
    else if (is_mask(piece) || known == places.end() || known->second == place)
      return false;
    else
      moved = true;
  }
  return filled && moved;
}

Bits BitOperations::choose(int mask, const Bits& a, const Bits& b) {
  // Choose number by number: cut where a piece of both operands ends.
  const std::set<unsigned> ends = ends_of(a), others = ends_of(b);
  Bits chosen;
  unsigned low = 0;
  for (const unsigned high : ends) {
    if (others.count(high) == 0) continue;
    const Bits p = slice(a, low, high - low), q = slice(b, low, high - low);
    low = high;
    append(chosen,
           is_shifted(p, q) || is_shifted(q, p) ? choose_words(mask, p, q) : choose_pieces(mask, p, q));
  }
  return chosen;
}

Bits BitOperations::choose_words(int mask, const Bits& a, const Bits& b) {
  Words words = to_words(a);
  const Words others = to_words(b);
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = graph().select(mask, words[i], others[i]);
  return from_words(words, width_of(a));
}

/// Cut both operands where a piece of either ends, and choose each part.
Bits BitOperations::choose_pieces(int mask, const Bits& a, const Bits& b) {
  std::set<unsigned> ends = ends_of(a);
  ends.merge(ends_of(b));
  Bits chosen;
  unsigned low = 0;
  for (const unsigned high : ends) {
    const Bits p = slice(a, low, high - low), q = slice(b, low, high - low);
    low = high;
    const Piece &x = p[0], &y = q[0];
    if (x.width == 1 || (is_mask(x) && is_mask(y))) {
      append(chosen, {graph().select(mask, to_mask(p), to_mask(q)), 0, x.width});
    } else if (!is_mask(x) && !is_mask(y) && x.low == y.low) {
      note(x, false);
      note(y, false);
      append(chosen, {graph().select(mask, x.node, y.node), x.low, x.width});
    } else {
      append(chosen, {graph().select(mask, to_vector(p, false), to_vector(q, false)), 0, x.width});
    }
  }
  return chosen;
}

Bits BitOperations::invert(const Bits& a) {
  const unsigned width = width_of(a);
  if (width == 1) return whole(graph().invert(to_mask(a)), 1);
  Words words = to_words(a);
  for (int& word : words) word = graph().invert(word);
  return from_words(words, width);
}

/// Add words from the least significant one on. `carry` is a mask or a one-bit number.
Bits BitOperations::sum(const Bits& a, const Bits& b, int carry) {
  const Words x = to_words(a), y = to_words(b);
  Words words;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const int part = graph().operate(LaneOp::add, x[i], y[i]);
    words.push_back(graph().operate(LaneOp::add, part, graph()[carry].mask ? graph().fill(carry, 1) : carry));
    if (i + 1 == x.size()) break;
    if (!graph()[carry].mask) carry = graph().bit(carry, 0);
    const int wraps = graph().compare(LaneOp::equal, words.back(), graph().constant(0));
    carry = graph().operate(LaneOp::either, graph().compare(LaneOp::less, part, x[i]),
                            graph().operate(LaneOp::both, carry, wraps));
  }
  return from_words(words, width_of(a));
}

Bits BitOperations::add(const Bits& a, const Bits& b) {
  if (width_of(a) > 1 && has_constant_one(a)) return sum_with_carry(a, b);
  if (width_of(a) > 1 && has_constant_one(b)) return sum_with_carry(b, a);
  return sum(a, b, graph().mask_constant(false));
}

Bits BitOperations::difference(const Bits& a, const Bits& b) {
  const unsigned width = width_of(a);
  if (width <= c_lane_word)
    return whole(graph().operate(LaneOp::subtract, to_vector(a), to_vector(b)), width);
  return sum(a, invert(b), graph().mask_constant(true));
}

/// A bit as a mask, without a note for the layout.
int BitOperations::bit_of(const Bits& bits, unsigned index) {
  const Piece piece = slice(bits, index, 1).front();
  return is_mask(piece) ? piece.node : graph().bit(piece.node, piece.low);
}

/// The number is the sign extension of this number of its lowest bits.
unsigned BitOperations::signed_width(const Bits& bits) {
  unsigned width = width_of(bits);
  const int sign = bit_of(bits, width - 1);
  while (width > 1 && bit_of(bits, width - 2) == sign) --width;
  return width;
}

Bits BitOperations::product(const Bits& a, const Bits& b) {
  const unsigned width = width_of(a);
  if (width > c_lane_word && width <= 2 * c_lane_word && signed_width(a) <= c_lane_word &&
      signed_width(b) <= c_lane_word) {
    const int x = to_vector(slice(a, 0, c_lane_word)), y = to_vector(slice(b, 0, c_lane_word));
    return from_words(
        {graph().operate(LaneOp::multiply, x, y), graph().operate(LaneOp::signed_multiply_high, x, y)},
        width);
  }
  const Words x = to_words(a), y = to_words(b);
  Bits total = zeros(width);
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; i + j < x.size(); ++j) {
      Words words(x.size(), graph().constant(0));
      words[i + j] = graph().operate(LaneOp::multiply, x[i], y[j]);
      if (i + j + 1 < x.size()) words[i + j + 1] = graph().operate(LaneOp::multiply_high, x[i], y[j]);
      total = sum(total, from_words(words, width), graph().mask_constant(false));
    }
  }
  return total;
}

/// Whether the lowest piece is a single constant one.
bool BitOperations::has_constant_one(const Bits& bits) {
  const Piece& low = bits.front();
  const LaneNode& node = graph()[low.node];
  return low.width == 1 && node.op == LaneOp::constant && (node.value >> low.low & 1) != 0;
}

/// (x, 1) + (y, carry): the RTL adds a carry by one sum. The upper bits are x + y + carry.
Bits BitOperations::sum_with_carry(const Bits& a, const Bits& b) {
  const unsigned width = width_of(a) - 1;
  const Bits carry = slice(b, 0, 1);
  Bits bits = whole(graph().invert(to_mask(carry)), 1);
  int node = carry.front().node;
  if (const LaneNode& at = graph()[node]; at.op == LaneOp::mask_cell && !step_.cells[at.value].input)
    layout_.numbers.insert({step_.cells[at.value].signal, step_.cells[at.value].low});
  else if (at.op != LaneOp::cell || at.bits != 1)
    node = to_mask(carry);
  append(bits, sum(slice(a, 1, width), slice(b, 1, width), node));
  return bits;
}

/// The most significant word that differs decides.
int BitOperations::compare(LaneOp op, const Bits& a, const Bits& b) {
  const unsigned top = top_width(width_of(a));
  Words x = to_words(a), y = to_words(b);
  for (Words* words : {&x, &y}) {
    // Move the sign to the top bit, or clear the bits above the number.
    int& last = words->back();
    last = op == LaneOp::signed_less ? graph().shift(last, static_cast<int>(c_lane_word - top))
                                     : graph().clean(last, top);
  }
  int mask = graph().mask_constant(op == LaneOp::equal);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const int same = graph().operate(LaneOp::both, graph().compare(LaneOp::equal, x[i], y[i]), mask);
    const LaneOp here = op == LaneOp::signed_less && i + 1 < x.size() ? LaneOp::less : op;
    mask =
        op == LaneOp::equal ? same : graph().operate(LaneOp::either, graph().compare(here, x[i], y[i]), same);
  }
  return mask;
}

int BitOperations::any_bit(const Bits& a) {
  int any = graph().mask_constant(false);
  for (const Piece& piece : a) {
    const int own =
        is_mask(piece) ? piece.node : graph().invert(compare(LaneOp::equal, {piece}, zeros(piece.width)));
    any = graph().operate(LaneOp::either, any, own);
  }
  return any;
}

/// Shifts by a constant.
Bits BitOperations::shifted(std::string_view op, const Bits& a, unsigned distance) {
  const unsigned width = width_of(a), kept = width - distance;
  Bits bits = op == "shiftl" ? zeros(distance) : slice(a, distance, kept);
  append(bits, op == "shiftl"   ? slice(a, 0, kept)
               : op == "shiftr" ? zeros(distance)
                                : whole(to_mask(slice(a, width - 1, 1)), distance));
  return bits;
}

Bits BitOperations::shift(std::string_view op, const Bits& a, const Bits& by) {
  const unsigned width = width_of(a);
  if (by.size() == 1 && graph()[by[0].node].op == LaneOp::constant)
    return shifted(op, a, static_cast<unsigned>(std::min<std::uint64_t>(graph()[by[0].node].value, width)));
  // Shift several words by each bit of the distance.
  if (width > c_lane_word) {
    Bits bits = a;
    for (unsigned bit = 0; bit < width_of(by); ++bit) {
      const unsigned distance = std::min(width, 1U << std::min(bit, c_lane_word - 1));
      bits = choose(to_mask(slice(by, bit, 1)), shifted(op, bits, distance), bits);
      bits = from_words(to_words(bits), width);
    }
    return bits;
  }
  const int distance = graph().clean(to_vector(by), width_of(by));
  int vector = to_vector(a);
  if (op == "shiftl") return whole(graph().operate(LaneOp::left_by, vector, distance), width);
  if (op == "shiftr")
    return whole(graph().operate(LaneOp::right_by, graph().clean(vector, width), distance), width);
  vector = graph().shift(vector, static_cast<int>(c_lane_word - width));
  vector = graph().operate(LaneOp::signed_right_by, vector, graph().constant(c_lane_word - width));
  return whole(graph().operate(LaneOp::signed_right_by, vector, distance), width);
}

}  // namespace halfway

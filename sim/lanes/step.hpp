// SPDX-License-Identifier: Apache-2.0
// What the hardware does in one clock, as a graph: the values of its outputs, and what its registers and
// memories become at the rising edge under which condition. Each phase of the generator reads or refines it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/lanes/lane_graph.hpp"

namespace halfway {

/// `width` bits of a vector, from bit `low` up, or a mask repeated `width` times.
struct Piece {
  int node;
  unsigned low, width;
  friend auto operator<=>(const Piece&, const Piece&) = default;
};

/// A signal as a list of pieces, the least significant first: slices, concatenations and extensions only
/// rearrange them.
using Bits = std::vector<Piece>;

/// Vectors that form one number, the least significant first.
using Words = std::vector<int>;

unsigned width_of(const Bits& bits);

/// The lowest `width` bits, at most a word, as ones.
std::uint64_t low_ones(unsigned width);

/// Up to one word of a register or an input, which is a variable of the generated text.
struct Cell {
  std::string signal;
  unsigned low, width;
  bool input;
  bool dirty;  ///< bits above `width` are undefined
  bool mask;
};

/// A condition: masks that are all true, or all false, as given with each.
using Guard = std::set<std::pair<int, bool>>;

/// Adds a condition and, if they follow from it, its operands. Empty if the guard can then never hold.
std::optional<Guard> narrow(const LaneGraph& graph, Guard guard, int mask, bool wanted);

/// Whether the operands of a mask follow from its value: both operands of a true `and`, or of a false `or`.
bool implies_operands(const LaneNode& mask, bool wanted);

/// Whether both guards can never hold at the same time.
bool excludes(const Guard& a, const Guard& b);

struct Update {
  std::size_t cell;
  int value;
};

/// What one place of a memory becomes.
struct Store {
  Guard guard;
  int address;
  Words words;
};

/// What is assigned to a register, and when. Registers with equal assignments are twins.
using Assignments = std::vector<std::pair<Guard, Bits>>;

/// One clock with `reset` either 0 or 1.
struct Step {
  LaneGraph graph;
  std::vector<Cell> cells;
  std::map<Guard, std::vector<Update>> updates;
  std::map<std::string, Store> stores;              ///< by memory
  std::map<std::string, std::vector<int>> outputs;  ///< words, or one mask
  std::map<std::string, Assignments> assignments;   ///< by register
};

}  // namespace halfway

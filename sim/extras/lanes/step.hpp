// SPDX-License-Identifier: Apache-2.0
// The hardware's behaviour in one clock, as a graph: the values of its outputs, and the new values of its
// registers and memories at the rising edge with their conditions. Each phase of the generator reads or
// refines it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/extras/lanes/lane_graph.hpp"

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

/// Up to one word of a register or an input, which is a variable of the generated text.
struct Cell {
  std::string signal;
  unsigned low, width;
  bool input;
  bool dirty;  ///< bits above `width` are undefined
  bool mask;
};

/// A condition: masks and the value that each must have.
using Guard = std::set<std::pair<int, bool>>;

/// Add a condition and, if they follow from it, the values of its operands. Empty if the guard can then never
/// be true.
std::optional<Guard> narrow(const LaneGraph& graph, Guard guard, int mask, bool wanted);

/// True if the operands of a mask follow from its value: both operands of a true `and`, or of a false `or`.
bool implies_operands(const LaneNode& mask, bool wanted);

/// True if both guards can never be true at the same time.
bool excludes(const Guard& a, const Guard& b);

struct Update {
  std::size_t cell;
  int value;
};

/// The new value of one place of a memory.
struct Store {
  Guard guard;
  int address;
  Words words;
};

/// Values assigned to a register, with their conditions. Registers with equal assignments are twins.
using Assignments = std::vector<std::pair<Guard, Bits>>;

/// One clock with `reset` either 0 or 1.
struct Step {
  LaneGraph graph;
  std::vector<Cell> cells;
  std::map<Guard, std::vector<Update>> updates;
  std::map<std::string, Store> stores;              ///< by memory
  std::map<std::string, std::vector<int>> outputs;  ///< words, or one mask
  std::vector<Words> observed;                      ///< of LanePorts::observed; none in reset
  std::map<std::string, Assignments> assignments;   ///< by register
};

}  // namespace halfway

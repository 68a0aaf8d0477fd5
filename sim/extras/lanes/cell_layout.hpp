// SPDX-License-Identifier: Apache-2.0
// Phase 2 of the lane generator: how registers, inputs and memories are laid out in variables.
//
// A register is cut into cells where the netlist slices it, so that each field of a record becomes a register
// of its own, but not inside a field that arithmetic uses as one number. The layout is found by building the
// graph repeatedly, until nothing new is noted.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/extras/lanes/netlist_reader.hpp"
#include "sim/extras/lanes/step.hpp"

namespace halfway {

constexpr std::size_t c_bank_words = 4;  ///< words in one place of a bank

/// The number of each memory's first word, counted through all banks.
using MemoryWords = std::map<std::string, std::size_t>;

struct CellLayout {
  std::map<std::string, std::set<unsigned>> cuts;                        ///< by signal
  std::map<std::string, std::set<std::pair<unsigned, unsigned>>> uncut;  ///< ranges used as one number
  std::set<std::pair<std::string, unsigned>> dirty;                      ///< cells: signal and lowest bit
  std::set<std::pair<std::string, unsigned>> cleaned;                    ///< dirty cells cleaned when written
  std::set<std::pair<std::string, unsigned>> numbers;  ///< one-bit cells used by sums: no masks
  std::map<std::string, std::string> twins;            ///< registers equal to another one
  MemoryWords memory_words;
  bool words = false;  ///< cut at words too; not at first, because another cut may make it unnecessary
  friend bool operator==(const CellLayout&, const CellLayout&) = default;

  std::vector<Cell> cells_of(const std::string& signal, unsigned width, bool input) const;
};

/// Places memories that are written together next to each other, so that they share a bank. Without steps
/// each memory has banks of its own.
MemoryWords place_memories(const std::map<std::string, LaneMemory>& memories, const Step& step,
                           const Step& reset_step);

/// Notes registers that are assigned the same values under the same conditions in both steps.
void note_twins(CellLayout& layout, const Step& step, const Step& reset_step);

}  // namespace halfway

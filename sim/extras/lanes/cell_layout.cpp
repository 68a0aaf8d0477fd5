// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/lanes/cell_layout.hpp"

#include <algorithm>
#include <tuple>

namespace halfway {

std::vector<Cell> CellLayout::cells_of(const std::string& signal, unsigned width, bool input) const {
  // Collect the cuts that lie in no range used as one number.
  std::set<unsigned> at = {0, width};
  if (const auto found = cuts.find(signal); found != cuts.end())
    at.insert(found->second.begin(), found->second.end());
  if (const auto found = uncut.find(signal); found != uncut.end())
    for (const auto& [low, high] : found->second) at.erase(at.upper_bound(low), at.lower_bound(high));

  // Make a cell between each two cuts, and one per word if wider.
  std::vector<Cell> cells;
  for (auto next = at.begin(); *next != width;) {
    const unsigned begin = *next++;
    const unsigned longest = words ? c_lane_word : *next - begin;
    for (unsigned low = begin; low < *next; low += longest) {
      const unsigned bits = std::min(*next - low, longest);
      const std::pair<std::string, unsigned> cell{signal, low};
      cells.push_back({.signal = signal,
                       .low = low,
                       .width = bits,
                       .input = input,
                       .dirty = !input && dirty.count(cell) != 0 && cleaned.count(cell) == 0,
                       .mask = bits == 1 && numbers.count(cell) == 0});
    }
  }
  return cells;
}

MemoryWords place_memories(const std::map<std::string, LaneMemory>& memories, const Step& step,
                           const Step& reset_step) {
  MemoryWords first;
  std::size_t words = 0;
  const auto place = [&](const std::string& name) {
    first[name] = words;
    words += memories.at(name).words();
  };
  const auto end_bank = [&] { words = (words + c_bank_words - 1) / c_bank_words * c_bank_words; };

  // Group the written memories by size and by the conditions and addresses of writes; place the others.
  using When = std::pair<Guard, int>;
  std::map<std::tuple<std::size_t, When, When>, std::vector<std::string>> together;
  for (const auto& [name, memory] : memories) {
    const auto a = step.stores.find(name), b = reset_step.stores.find(name);
    if (a != step.stores.end() && b != reset_step.stores.end()) {
      together[{memory.places, {a->second.guard, a->second.address}, {b->second.guard, b->second.address}}]
          .push_back(name);
    } else {
      place(name);
      end_bank();
    }
  }
  for (const auto& [when, names] : together) {
    for (const std::string& name : names) place(name);
    end_bank();
  }
  return first;
}

void note_twins(CellLayout& layout, const Step& step, const Step& reset_step) {
  std::map<std::pair<Assignments, Assignments>, std::string> first;
  for (const auto& [name, assignments] : step.assignments) {
    const auto reset = reset_step.assignments.find(name);
    const Assignments none;
    const auto [twin, alone] =
        first.try_emplace({assignments, reset == reset_step.assignments.end() ? none : reset->second}, name);
    if (!alone) layout.twins[name] = twin->second;
  }
}

}  // namespace halfway

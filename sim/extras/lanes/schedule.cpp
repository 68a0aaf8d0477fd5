// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/lanes/schedule.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <optional>
#include <string>

#include "sim/os/must.hpp"

namespace halfway {
namespace {

bool is_cell(const LaneNode& node) {
  return node.op == LaneOp::cell || node.op == LaneOp::mask_cell;
}

/// The new values of the places of banks: the words of memories that share a bank are combined.
std::map<Guard, std::map<std::size_t, Store>> bank_stores(const Step& step, const MemoryWords& memory_words) {
  std::map<Guard, std::map<std::size_t, Store>> banks;
  for (const auto& [name, store] : step.stores) {
    for (std::size_t i = 0; i < store.words.size(); ++i) {
      const std::size_t word = memory_words.at(name) + i;
      Store& bank = banks[store.guard][word / c_bank_words];
      bank.address = store.address;
      bank.words.resize(c_bank_words, store.words[0]);
      bank.words[word % c_bank_words] = store.words[i];
    }
  }
  return banks;
}

/// The value that a cell takes, and its condition.
using Load = std::pair<Guard, int>;

/// The loads of all cells that have a single one.
std::map<std::size_t, Load> single_loads(const Step& step) {
  std::map<std::size_t, Load> loads;
  std::set<std::size_t> others;
  for (const auto& [guard, updates] : step.updates)
    for (const Update& update : updates)
      if (!loads.try_emplace(update.cell, guard, update.value).second) others.insert(update.cell);
  for (const std::size_t cell : others) loads.erase(cell);
  return loads;
}

class Scheduler {
 public:
  Scheduler(Step& step, const MemoryWords& memory_words, const CellSet& live, const Delays& delays)
      : step_(step), delays_(delays) {
    make_groups(memory_words, live);
  }

  Schedule make() {
    find_always();
    for (Group& group : schedule_.groups) find_uses(group);
    order();
    if (!schedule_.saved.empty() && *schedule_.saved.rbegin() >= c_first_bank)
      throw_tool_failed("the lanes do not support memories that read from one another at one edge");
    return std::move(schedule_);
  }

 private:
  void make_groups(const MemoryWords& memory_words, const CellSet& live) {
    for (const auto& [guard, updates] : step_.updates) {
      Group group{guard, condition_of(guard)};
      for (const Update& update : updates) add_update(group, update, live);
      put_masks_last(group);
      if (!group.updates.empty()) schedule_.groups.push_back(std::move(group));
    }
    for (const auto& [guard, banks] : bank_stores(step_, memory_words)) {
      Group group{guard, condition_of(guard)};
      for (const auto& [bank, store] : banks)
        if (live.count(c_first_bank + bank) != 0) group.banks.emplace(bank, store);
      if (!group.banks.empty()) schedule_.groups.push_back(std::move(group));
    }
  }

  /// A cell of a ring is not written, unless it is the head; the ring moves under the group's condition.
  void add_update(Group& group, const Update& update, const CellSet& live) {
    if (live.count(update.cell) == 0) return;
    const auto delay = delays_.find(update.cell);
    if (delay != delays_.end()) {
      schedule_.rings.resize(std::max(schedule_.rings.size(), delay->second.ring + 1));
      schedule_.rings[delay->second.ring] = group.condition;
    }
    if (delay == delays_.end() || delay->second.age == 0) group.updates.push_back(update);
  }

  int condition_of(const Guard& guard) {
    LaneGraph& graph = step_.graph;
    int all = graph.mask_constant(true);
    for (const auto& [mask, wanted] : guard) {
      if (implies_operands(graph[mask], wanted)) continue;  // the guard holds the operands too
      all = graph.operate(LaneOp::both, all, wanted ? mask : graph.invert(mask));
    }
    return all;
  }

  /// The cell that is a group's condition; it is read where the group starts.
  std::optional<std::size_t> condition_cell(const Group& group) const {
    const LaneNode& mask = step_.graph[group.condition];
    return mask.op == LaneOp::mask_cell ? std::optional<std::size_t>(mask.value) : std::nullopt;
  }

  /// A mask that the group writes may be the condition of its other updates: write masks last, and the
  /// group's own condition after all others.
  void put_masks_last(Group& group) const {
    std::ranges::stable_sort(group.updates, {}, [&](const Update& update) {
      return std::pair(step_.cells[update.cell].mask, condition_cell(group) == update.cell);
    });
  }

  void find_always() {
    std::vector<bool>& always = schedule_.always;
    CellSet cells;
    for (const auto& [output, words] : step_.outputs)
      for (const int word : words) mark_used(step_.graph, word, always, cells);
    for (const Group& group : schedule_.groups) mark_used(step_.graph, group.condition, always, cells);
    // A cell is read where it is used.
    always.resize(static_cast<std::size_t>(step_.graph.size()));
    for (int i = 0; i < step_.graph.size(); ++i)
      if (is_cell(step_.graph[i])) always[static_cast<std::size_t>(i)] = false;
  }

  void find_uses(Group& group) const {
    std::vector<bool> used = schedule_.always;
    mark_used(step_.graph, group.condition, used, group.reads);
    for (const Update& update : group.updates) {
      mark_used(step_.graph, update.value, used, group.reads);
      if (delays_.count(update.cell) == 0) group.writes.insert(update.cell);
    }
    for (const auto& [bank, store] : group.banks) {
      mark_used(step_.graph, store.address, used, group.reads);
      for (const int word : store.words) mark_used(step_.graph, word, used, group.reads);
      group.writes.insert(c_first_bank + bank);
    }
  }

  /// The cells that `first` writes and `later` must still read.
  CellSet overwritten(const Group& first, const Group& later) const {
    CellSet cells;
    if (excludes(first.guard, later.guard)) {
      // No lane runs both groups, but the later condition is read in all lanes.
      if (const auto cell = condition_cell(later); cell && first.writes.count(*cell) != 0)
        cells.insert(*cell);
    } else {
      std::set_intersection(first.writes.begin(), first.writes.end(), later.reads.begin(), later.reads.end(),
                            std::inserter(cells, cells.end()));
    }
    return cells;
  }

  /// Select as next group the one that overwrites the fewest cells read by remaining groups. A bank is too
  /// large to be saved, so it counts more than any number of cells.
  void order() {
    std::vector<Group> ordered, remaining = std::move(schedule_.groups);
    while (!remaining.empty()) {
      std::size_t best = 0;
      CellSet best_overwritten;
      const auto cost = [](const CellSet& cells) {
        return std::pair(std::distance(cells.lower_bound(c_first_bank), cells.end()), cells.size());
      };
      for (std::size_t i = 0; i < remaining.size(); ++i) {
        CellSet cells;
        for (std::size_t k = 0; k < remaining.size(); ++k)
          if (k != i) cells.merge(overwritten(remaining[i], remaining[k]));
        if (i == 0 || cost(cells) < cost(best_overwritten)) {
          best = i;
          best_overwritten = std::move(cells);
        }
      }
      schedule_.saved.merge(best_overwritten);
      ordered.push_back(std::move(remaining[best]));
      remaining.erase(remaining.begin() + static_cast<std::ptrdiff_t>(best));
    }
    schedule_.groups = std::move(ordered);
  }

  Step& step_;
  const Delays& delays_;
  Schedule schedule_;
};

}  // namespace

void mark_used(const LaneGraph& graph, int node, std::vector<bool>& used, CellSet& cells) {
  const auto index = static_cast<std::size_t>(node);
  if (index >= used.size()) used.resize(static_cast<std::size_t>(graph.size()));
  if (used[index]) return;
  used[index] = true;
  const LaneNode& at = graph[node];
  if (is_cell(at)) cells.insert(at.value);
  if (at.op == LaneOp::row) cells.insert(c_first_bank + at.value);
  for (const int operand : at.operands)
    if (operand >= 0) mark_used(graph, operand, used, cells);
}

CellSet live_cells(const Step& step, const MemoryWords& memory_words) {
  std::vector<bool> used;
  CellSet live;
  const auto mark = [&](int node) { mark_used(step.graph, node, used, live); };
  for (const auto& [name, words] : step.outputs)
    for (const int word : words) mark(word);
  for (const Words& part : step.observed)
    for (const int word : part) mark(word);
  const auto banks = bank_stores(step, memory_words);
  for (std::size_t before = SIZE_MAX; before != live.size();) {
    before = live.size();
    for (const auto& [guard, updates] : step.updates) {
      for (const Update& update : updates) {
        if (live.count(update.cell) == 0) continue;
        mark(update.value);
        for (const auto& literal : guard) mark(literal.first);
      }
    }
    for (const auto& [guard, stores] : banks) {
      for (const auto& [bank, store] : stores) {
        if (live.count(c_first_bank + bank) == 0) continue;
        mark(store.address);
        for (const int word : store.words) mark(word);
        for (const auto& literal : guard) mark(literal.first);
      }
    }
  }
  return live;
}

Delays find_delays(const Step& step, const Step& reset_step, const CellSet& live) {
  // Find the cells with a single load in each step, and those that then take another cell's value under the
  // same conditions.
  using Conditions = std::pair<Guard, Guard>;
  std::map<std::size_t, Conditions> loaded;
  std::map<std::size_t, std::size_t> sources;
  const auto loads = single_loads(step), reset_loads = single_loads(reset_step);
  for (const auto& [cell, load] : loads) {
    const auto reset_load = reset_loads.find(cell);
    if (live.count(cell) == 0 || step.cells[cell].mask || reset_load == reset_loads.end()) continue;
    loaded[cell] = {load.first, reset_load->second.first};
    const LaneNode &a = step.graph[load.second], &b = reset_step.graph[reset_load->second.second];
    if (a.op == LaneOp::cell && b.op == LaneOp::cell && a.value == b.value) sources[cell] = a.value;
  }
  std::map<std::size_t, std::vector<std::size_t>> followers;
  std::set<std::size_t> heads;
  for (const auto& [cell, conditions] : loaded) {
    const auto source = sources.find(cell);
    const auto head = source == sources.end() ? loaded.end() : loaded.find(source->second);
    if (head != loaded.end() && head->second == conditions)
      followers[head->first].push_back(cell);
    else
      heads.insert(cell);
  }

  // Follow each chain from its first cell; start a new place where one is too long for the ring.
  Delays delays;
  std::map<Conditions, std::size_t> rings;
  const std::function<void(std::size_t, Delay)> follow = [&](std::size_t cell, Delay delay) {
    if (delay.age > c_oldest) delay = {delay.ring, cell, 0};
    delays[cell] = delay;
    if (const auto found = followers.find(cell); found != followers.end())
      for (const std::size_t next : found->second) follow(next, {delay.ring, delay.head, delay.age + 1});
  };
  for (const std::size_t head : heads)
    if (followers.count(head) != 0)
      follow(head, {rings.try_emplace(loaded.at(head), rings.size()).first->second, head, 0});
  return delays;
}

Schedule make_schedule(Step& step, const MemoryWords& memory_words, const CellSet& live,
                       const Delays& delays) {
  return Scheduler(step, memory_words, live, delays).make();
}

std::pair<int, int> changed_lanes(const Step& step, const Delays& delays, const Update& update) {
  const LaneNode& node = step.graph[update.value];
  if (node.op != LaneOp::select || delays.count(update.cell) != 0) return {-1, update.value};
  const LaneNode& other = step.graph[node.operands[2]];
  if (other.op != LaneOp::cell || other.value != update.cell) return {-1, update.value};
  return {node.operands[0], node.operands[1]};
}

}  // namespace halfway

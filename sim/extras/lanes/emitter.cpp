// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/lanes/emitter.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <map>
#include <vector>

namespace halfway {
namespace {

/// The text of one function.
class StepEmitter {
 public:
  StepEmitter(const ScheduledStep& scheduled, const Delays& delays)
      : step_(scheduled.step), schedule_(scheduled.schedule), delays_(delays) {}

  std::string emit(const std::string& name) {
    text_ = "LANE_STEP void " + name + "(State& s, const Inputs& in, Outputs& out) {\n";
    emit_rings();
    for (const std::size_t cell : schedule_.saved)
      text_ += fmt::format("  const {0} o{1} = s.c{1};\n", type_of(cell), cell);
    emit_nodes(schedule_.always, {});
    emit_outputs();
    emit_moves();
    in_group_ = true;
    for (const Group& group : schedule_.groups) emit_group(group);
    for (std::size_t i = 0; i < schedule_.rings.size(); ++i)
      text_ += fmt::format("  advance(s.ring{0}, moves{0});\n", i);
    return text_ + "}\n";
  }

  /// c_observed_words and observe().
  std::string emit_observe() {
    Words words;
    for (const Words& part : step_.observed) words.insert(words.end(), part.begin(), part.end());
    text_ = fmt::format("constexpr std::size_t c_observed_words = {};\n", words.size()) +
            "LANE_STEP void observe(const State& s, const Inputs& in, std::uint32_t* words) {\n";
    emit_late();
    std::vector<bool> used;
    CellSet cells;
    for (const int word : words) mark_used(step_.graph, word, used, cells);
    emit_nodes(used, {});
    for (std::size_t i = 0; i < words.size(); ++i)
      text_ += fmt::format("  words[{}] = {}[0];\n", i, reference(words[i]));
    return text_ + "}\n";
  }

 private:
  void emit_rings() {
    for (std::size_t i = 0; i < schedule_.rings.size(); ++i)
      text_ += fmt::format("  Late{0}& next{0} = s.ring{0}.next();\n", i);
    emit_late();
  }
  void emit_late() {
    for (std::size_t i = 0; i < schedule_.rings.size(); ++i)
      for (unsigned age = 0; age <= c_oldest; ++age)
        text_ += fmt::format("  const Late{0}& late{0}_{1} = s.ring{0}.late({1});\n", i, age);
  }

  /// The masks of the rings, before a group changes a cell that is one of them.
  void emit_moves() {
    for (std::size_t i = 0; i < schedule_.rings.size(); ++i)
      text_ += fmt::format("  const M moves{} = {};\n", i, reference(schedule_.rings[i]));
  }

  void emit_outputs() {
    for (const auto& [output, words] : step_.outputs) {
      for (std::size_t i = 0; i < words.size(); ++i) {
        text_ += fmt::format("  out.{}{} = {};\n", output, words.size() == 1 ? "" : fmt::format("[{}]", i),
                             reference(words[i]));
      }
    }
  }

  void emit_group(const Group& group) {
    // Open the block, unless it runs in every clock.
    const bool always = step_.graph[group.condition].op == LaneOp::mask_constant;
    const std::string condition = reference(group.condition);
    text_ += always ? "  {\n" : fmt::format("  if (any({})) {{\n", condition);

    // Calculate what the group needs.
    std::vector<bool> used = schedule_.always;
    CellSet cells;
    for (const Update& update : group.updates) {
      const auto [where, value] = changed_lanes(step_, delays_, update);
      for (const int node : {where, value})
        if (node >= 0) mark_used(step_.graph, node, used, cells);
    }
    for (const auto& [bank, store] : group.banks) {
      mark_used(step_.graph, store.address, used, cells);
      for (const int word : store.words) mark_used(step_.graph, word, used, cells);
    }
    emit_nodes(used, schedule_.always);

    // Read all new values before the first register changes.
    for (const Update& update : group.updates)
      text_ += fmt::format("  const {} n{} = {};\n", type_of(update.cell), update.cell,
                           reference(changed_lanes(step_, delays_, update).second));
    for (const Update& update : group.updates) emit_update(update, always ? "" : condition);
    for (const auto& [bank, store] : group.banks) {
      text_ += fmt::format("  store(s.bank{}, {}, {}, {{", bank, condition, reference(store.address));
      for (const int word : store.words) text_ += reference(word) + ", ";
      text_ += "});\n";
    }
    text_ += "  }\n";
  }

  /// `mask`: the lanes to update; empty: all.
  void emit_update(const Update& update, std::string mask) {
    const int where = changed_lanes(step_, delays_, update).first;
    if (where >= 0) mask += (mask.empty() ? "" : " & ") + reference(where);
    const auto delay = delays_.find(update.cell);
    const std::string to = delay == delays_.end() ? "s" : fmt::format("next{}", delay->second.ring);
    if (delay != delays_.end()) mask.clear();
    text_ += mask.empty() ? fmt::format("  {1}.c{0} = n{0};\n", update.cell, to)
                          : fmt::format("  assign({1}, s.c{0}, n{0});\n", update.cell, mask);
  }

  /// The nodes of `used` that are not in `known`, each as a constant.
  void emit_nodes(const std::vector<bool>& used, const std::vector<bool>& known) {
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (!used[i] || (i < known.size() && known[i])) continue;
      const int number = static_cast<int>(i);
      const LaneNode& node = step_.graph[number];
      const std::string expression = expression_of(node);
      if (expression.empty()) continue;
      const char* type = node.mask ? "M" : node.op == LaneOp::row ? "Row" : "V";
      text_ += fmt::format("  const {} {} = {};\n", type, reference(number), expression);
    }
  }

  const char* type_of(std::size_t cell) const { return step_.cells[cell].mask ? "M" : "V"; }

  /// How a node is read.
  std::string reference(int number) const {
    const LaneNode& node = step_.graph[number];
    switch (node.op) {
      case LaneOp::constant:
        return fmt::format("splat({:#x}u)", node.value);
      case LaneOp::mask_constant:
        return node.value != 0 ? "c_all" : "c_none";
      case LaneOp::cell:
      case LaneOp::mask_cell:
        return cell_reference(node.value);
      default:
        return fmt::format("{}{}", node.mask ? 'm' : 'v', number);
    }
  }

  std::string cell_reference(std::size_t number) const {
    const Cell& cell = step_.cells[number];
    const bool first = cell.low == 0;
    const bool last = number + 1 == step_.cells.size() || step_.cells[number + 1].signal != cell.signal;
    if (cell.input && cell.width == 1 && first && last) return "in." + cell.signal;
    if (cell.input) return fmt::format("in.c{}", number);
    if (const auto delay = delays_.find(number); delay != delays_.end())
      return fmt::format("late{}_{}.c{}", delay->second.ring, delay->second.age, delay->second.head);
    return fmt::format("{}{}", in_group_ && schedule_.saved.count(number) != 0 ? "o" : "s.c", number);
  }

  /// Empty for a node that is read where it is used.
  std::string expression_of(const LaneNode& node) const {
    // On operands 0 to 2 and the node's value, 3.
    static const std::map<LaneOp, const char*> c_texts = {
        {LaneOp::add, "{0} + {1}"},
        {LaneOp::subtract, "{0} - {1}"},
        {LaneOp::multiply, "{0} * {1}"},
        {LaneOp::multiply_high, "multiply_high({0}, {1})"},
        {LaneOp::signed_multiply_high, "signed_multiply_high({0}, {1})"},
        {LaneOp::left_by, "left_by({0}, {1})"},
        {LaneOp::right_by, "right_by({0}, {1})"},
        {LaneOp::signed_right_by, "signed_right_by({0}, {1})"},
        {LaneOp::both, "{0} & {1}"},
        {LaneOp::either, "{0} | {1}"},
        {LaneOp::differ, "{0} ^ {1}"},
        {LaneOp::invert, "invert({0})"},
        {LaneOp::select, "select({0}, {1}, {2})"},
        {LaneOp::left, "{0} << {3}"},
        {LaneOp::right, "{0} >> {3}"},
        {LaneOp::fill, "fill({0}, {3:#x}u)"},
        {LaneOp::rom, "lookup(c_rom{3}, {0})"},
        {LaneOp::row, "load(s.bank{3}, {0})"},
        {LaneOp::word, "{0}.words[{3}]"},
        {LaneOp::bit, "test({0}, 1u << {3})"},
        {LaneOp::equal, "equal({0}, {1})"},
        {LaneOp::less, "less({0}, {1})"},
        {LaneOp::signed_less, "signed_less({0}, {1})"}};
    const auto text = c_texts.find(node.op);
    if (text == c_texts.end()) return {};
    std::array<std::string, 3> x;
    for (std::size_t i = 0; i < 3 && node.operands[i] >= 0; ++i) x[i] = reference(node.operands[i]);
    return fmt::format(fmt::runtime(text->second), x[0], x[1], x[2], node.value);
  }

  const Step& step_;
  const Schedule& schedule_;
  const Delays& delays_;
  std::string text_;
  bool in_group_ = false;  ///< registers may have changed already: read saved values
};

/// The structs and tables that both functions use.
class StateEmitter {
 public:
  StateEmitter(const EmittedHardware& hardware, const Step& step) : hardware_(hardware), step_(step) {}

  std::string emit() {
    for (std::size_t i = 0; i < step_.cells.size(); ++i)
      step_.cells[i].input ? add_input(i) : add_register(i);
    add_banks();
    std::string rings;
    for (const auto& [ring, cells] : rings_) {
      rings += fmt::format("struct Late{} {{\n{}}};\n", ring, cells);
      masks_ += fmt::format("  Ring<Late{0}, {1}> ring{0};\n", ring, c_ring_places);
    }
    return rings + "struct State {\n" + vectors_ + masks_ + "};\nstruct Inputs {\n" + inputs_ +
           "};\nstruct Outputs {\n" + outputs() + "};\n" + registers() + tables() + setters();
  }

 private:
  void add_register(std::size_t number) {
    if (hardware_.live.count(number) == 0) return;
    const auto delay = hardware_.delays.find(number);
    if (step_.cells[number].mask) {
      masks_ += fmt::format("  M c{}{{}};\n", number);
    } else if (delay == hardware_.delays.end()) {
      vectors_ += fmt::format("  V c{}{{}};\n", number);
    } else if (delay->second.age == 0) {
      rings_[delay->second.ring] += fmt::format("  V c{}{{}};\n", number);
    }
  }

  /// An input of one bit is a mask by its name; a wider one is set lane by lane.
  void add_input(std::size_t number) {
    const Cell& cell = step_.cells[number];
    if (hardware_.netlist.inputs.at(cell.signal) == 1) {
      inputs_ += fmt::format("  M {}{{}};\n", cell.signal);
      return;
    }
    std::string& setter = setters_[cell.signal];
    if (hardware_.live.count(number) == 0) return;
    inputs_ += fmt::format("  {} c{}{{}};\n", cell.mask ? "M" : "V", number);
    setter += fmt::format("  set_lane(in.c{}, lane, field<{}, {}>(words));\n", number, cell.low, cell.width);
  }

  void add_banks() {
    std::map<std::size_t, std::size_t> places;
    for (const auto& [name, memory] : hardware_.netlist.memories)
      for (std::size_t i = 0; i < memory.words(); ++i)
        places[(hardware_.memory_words.at(name) + i) / c_bank_words] = memory.places;
    for (const auto& [bank, count] : places)
      if (hardware_.live.count(c_first_bank + bank) != 0)
        masks_ += fmt::format("  Memory<{}> bank{};\n", count, bank);
  }

  std::string outputs() const {
    std::string text;
    for (const auto& [name, words] : step_.outputs) {
      text += fmt::format("  {} {}{};\n", step_.graph[words[0]].mask ? "M" : "V", name,
                          words.size() == 1 ? "" : fmt::format("[{}]", words.size()));
    }
    return text;
  }

  /// The registers that are variables of their own, not in a ring.
  std::string registers() const {
    std::string text = "constexpr Register c_registers[] = {\n";
    for (std::size_t i = 0; i < step_.cells.size(); ++i) {
      const Cell& cell = step_.cells[i];
      if (cell.input || !hardware_.live.contains(i) || hardware_.delays.contains(i)) continue;
      const unsigned bits = hardware_.netlist.registers.at(cell.signal);
      text += fmt::format("  {{\"{}\", {}, {}, offsetof(State, c{})}},\n",
                          hardware_.names.name(cell.signal, bits, cell.low, cell.width), cell.width,
                          cell.mask, i);
    }
    return text + "};\n";
  }

  std::string tables() const {
    std::string text;
    for (std::size_t i = 0; i < hardware_.netlist.tables.size(); ++i) {
      const std::vector<std::uint32_t>& table = hardware_.netlist.tables[i];
      text += fmt::format("constexpr std::uint32_t c_rom{}[{}] = {{{}}};\n", i, table.size(),
                          fmt::join(table, ","));
    }
    return text;
  }

  std::string setters() const {
    std::string text;
    for (const auto& [name, setter] : setters_) {
      text += fmt::format(
          "LANE_FUNCTION void set_{}(Inputs& in, unsigned lane, const std::uint32_t* words) {{\n{}}}\n", name,
          setter);
    }
    return text;
  }

  const EmittedHardware& hardware_;
  const Step& step_;
  std::string vectors_, masks_, inputs_;
  std::map<std::size_t, std::string> rings_;    ///< the members of a place
  std::map<std::string, std::string> setters_;  ///< the statements, by input
};

}  // namespace

std::string emit_lanes(const EmittedHardware& hardware, const ScheduledStep& step,
                       const ScheduledStep& reset_step) {
  const std::string text = StateEmitter(hardware, step.step).emit() +
                           StepEmitter(step, hardware.delays).emit("step") +
                           StepEmitter(reset_step, hardware.delays).emit("reset_step");
  return text + StepEmitter(step, hardware.delays).emit_observe();
}

}  // namespace halfway

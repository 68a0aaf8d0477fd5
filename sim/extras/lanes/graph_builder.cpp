// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/lanes/graph_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <tuple>

#include "sim/extras/lanes/bit_operations.hpp"
#include "sim/extras/lanes/register_updates.hpp"

namespace halfway {
namespace {

constexpr std::size_t c_most_places = 4096;  ///< of a memory; each lane has its own

class GraphBuilder {
 public:
  GraphBuilder(const LaneNetlist& netlist, const LanePorts& ports, bool reset, CellLayout& layout)
      : netlist_(netlist), ports_(ports), reset_(reset), layout_(layout) {
    for (const auto& [signals, input] : {std::pair(&netlist.inputs, true), {&netlist.registers, false}}) {
      for (const auto& [name, width] : *signals) {
        if (layout.twins.count(name) != 0) continue;
        first_cell_[name] = step_.cells.size();
        for (Cell& cell : layout.cells_of(name, width, input)) step_.cells.push_back(std::move(cell));
      }
    }
  }

  Step build() {
    // Outputs before the clock's edge.
    for (const std::string& name : ports_.outputs) {
      const Bits bits = signal(name);
      auto& words = step_.outputs[name];
      const unsigned width = width_of(bits);
      if (width == 1) {
        words.push_back(ops_.to_mask(bits));
      } else {
        words = ops_.to_words(bits, false);
        words.back() = graph().clean(words.back(), ops_.top_width(width));
      }
    }
    // Registers and memories after it.
    for (const pugi::xml_node statement : netlist_.clocked) execute(statement, {});
    if (!reset_) {
      // Drop the notes of observed parts: reading a signal leaves the rest of the text as it is.
      CellLayout dropped = layout_;
      BitOperations reading(step_, dropped);
      for (const ObservedPart& part : ports_.observed) {
        const Bits bits = ops_.slice(signal(part.path), part.low, part.bits);
        Words& words = step_.observed.emplace_back(reading.to_words(bits));
        words.back() = graph().clean(words.back(), ops_.top_width(width_of(bits)));
      }
    }
    return std::move(step_);
  }

 private:
  LaneGraph& graph() { return step_.graph; }
  [[noreturn]] static void fail(const std::string& what) { BitOperations::fail(what); }

  /// The text of an expression in the netlist, for messages.
  static std::string line_of(pugi::xml_node node) {
    const std::string_view place = node.attribute("loc").value();
    const std::size_t comma = place.find(',');
    if (comma == std::string_view::npos) return "netlist.v";
    return "netlist.v:" + std::string(place.substr(comma + 1, place.find(',', comma + 1) - comma - 1));
  }

  // Expressions

  Bits signal(const std::string& name) {
    if (const auto known = signals_.find(name); known != signals_.end()) {
      if (known->second.empty()) fail(name + ": depends on itself without a register");
      return known->second;
    }
    if (const auto fixed = ports_.fixed.find(name); fixed != ports_.fixed.end())
      return ops_.whole(graph().mask_constant(fixed->second), 1);
    if (name == "reset") return ops_.whole(graph().mask_constant(reset_), 1);
    if (const auto twin = layout_.twins.find(name); twin != layout_.twins.end()) return signal(twin->second);
    if (const auto cells = first_cell_.find(name); cells != first_cell_.end()) {
      Bits bits;
      for (std::size_t i = cells->second; i < step_.cells.size() && step_.cells[i].signal == name; ++i) {
        const Cell& cell = step_.cells[i];
        const unsigned known = cell.dirty ? std::max(cell.width, c_lane_word) : cell.width;
        bits.push_back({cell.mask ? graph().mask_cell(i) : graph().cell(i, known), 0, cell.width});
      }
      return bits;
    }
    const auto driver = netlist_.drivers.find(name);
    if (driver == netlist_.drivers.end()) fail(name + ": has no driver that the lanes support");
    signals_[name] = {};
    return signals_[name] = value(driver->second);
  }

  Bits literal(pugi::xml_node node) {
    const unsigned width = netlist_.width_of(node);
    std::string_view digits = node.attribute("name").value();
    const std::size_t quote = digits.find('\'');
    if (quote == std::string_view::npos) fail(line_of(node) + ": a constant without a base");
    digits.remove_prefix(quote + 1);
    if (digits.substr(0, 1) == "s") digits.remove_prefix(1);
    const unsigned step = digits.substr(0, 1) == "h" ? 4 : digits.substr(0, 1) == "b" ? 1 : 0;
    if (step == 0) fail(line_of(node) + ": a constant of an unknown base");
    digits.remove_prefix(1);
    std::vector<std::uint64_t> words(width / c_lane_word + 1);
    unsigned at = 0;
    for (auto digit = digits.rbegin(); digit != digits.rend() && at < width; ++digit, at += step) {
      // Unknown bits are zero, as in Verilator with --x-assign fast.
      const std::size_t found = std::string_view("0123456789abcdef").find(*digit);
      words[at / c_lane_word] |= (found == std::string_view::npos ? 0 : std::uint64_t{found})
                                 << at % c_lane_word;
    }
    Bits bits;
    for (unsigned low = 0; low < width; low += c_lane_word)
      ops_.append(bits, ops_.constant(words[low / c_lane_word], std::min(width - low, c_lane_word)));
    return bits;
  }

  std::optional<std::uint64_t> number(pugi::xml_node node) {
    if (std::string_view(node.name()) != "const") return std::nullopt;
    const Bits bits = literal(node);
    return bits.size() == 1 ? std::optional(graph()[bits[0].node].value) : std::nullopt;
  }

  Bits value(pugi::xml_node node) {
    const std::string_view op = node.name();
    if (op == "varref") return signal(node.attribute("name").value());
    if (op == "const") return literal(node);
    const unsigned width = netlist_.width_of(node);
    const pugi::xml_node first = node.first_child(), second = first.next_sibling();
    if (!first) fail(fmt::format("{}: the lanes do not support '{}'", line_of(node), op));
    if (op == "arraysel") return element(node);
    if (op == "sel") {
      const auto low = number(second), count = number(second.next_sibling());
      if (!low || !count) fail(line_of(node) + ": a slice with a position that is not constant");
      return part(first, static_cast<unsigned>(*low), static_cast<unsigned>(*count));
    }
    const Bits a = value(first);
    if (op == "extend" || op == "extends") {
      if (width_of(a) > width) fail(line_of(node) + ": an extension that narrows");
      Bits bits = a;
      const unsigned more = width - width_of(a);
      ops_.append(bits, op == "extend" ? ops_.zeros(more)
                                       : ops_.whole(ops_.to_mask(ops_.slice(a, width_of(a) - 1, 1)), more));
      return bits;
    }
    if (op == "not") return ops_.invert(a);
    if (op == "lognot") return ops_.invert(ops_.whole(ops_.any_bit(a), 1));
    if (op == "redor") return ops_.whole(ops_.any_bit(a), 1);
    if (op == "negate") return ops_.difference(ops_.zeros(width), a);
    if (op == "replicate") {
      const auto count = number(second);
      if (!count) fail(line_of(node) + ": a replication with a count that is not constant");
      Bits bits;
      if (width_of(a) == 1) return ops_.whole(ops_.to_mask(a), static_cast<unsigned>(*count));
      for (std::uint64_t i = 0; i < *count; ++i) ops_.append(bits, a);
      return bits;
    }
    if (!second) fail(fmt::format("{}: the lanes do not support '{}'", line_of(node), op));
    const Bits b = value(second);
    if (op == "concat") {
      Bits bits = b;
      ops_.append(bits, a);
      return bits;
    }
    if (op == "logand" || op == "logor")
      return binary(node, op.substr(3), ops_.whole(ops_.any_bit(a), 1), ops_.whole(ops_.any_bit(b), 1));
    if (op == "cond") return ops_.choose(ops_.to_mask(a), b, value(second.next_sibling()));
    return binary(node, op, a, b);
  }

  /// A slice of an expression. Only the slice is built where a signal is put together from parts: one part of
  /// a signal may depend on another one.
  Bits part(pugi::xml_node node, unsigned low, unsigned width) {
    const std::string_view op = node.name();
    if (op == "concat") {
      const pugi::xml_node high_part = node.first_child(), low_part = high_part.next_sibling();
      const unsigned split = netlist_.width_of(low_part);
      if (low >= split) return part(high_part, low - split, width);
      if (low + width <= split) return part(low_part, low, width);
      Bits bits = part(low_part, low, split - low);
      ops_.append(bits, part(high_part, 0, low + width - split));
      return bits;
    }
    if (op == "varref") {
      const std::string name = node.attribute("name").value();
      const auto driver = netlist_.drivers.find(name);
      const auto known = signals_.find(name);
      const bool built = known != signals_.end() && !known->second.empty();
      if (!built && driver != netlist_.drivers.end() && is_rearrangement(driver->second)) {
        if (!parts_.insert({name, low, width}).second) fail(name + ": depends on itself without a register");
        Bits bits = part(driver->second, low, width);
        parts_.erase({name, low, width});
        return bits;
      }
    }
    if (op == "sel")
      if (const auto inner = number(node.first_child().next_sibling()))
        return part(node.first_child(), low + static_cast<unsigned>(*inner), width);
    return ops_.slice(value(node), low, width);
  }
  static bool is_rearrangement(pugi::xml_node node) {
    const std::string_view op = node.name();
    return op == "concat" || op == "sel" || op == "varref";
  }

  Bits binary(pugi::xml_node node, std::string_view op, const Bits& a, const Bits& b) {
    const unsigned width = netlist_.width_of(node), operand = width_of(a);
    if (op == "shiftl" || op == "shiftr" || op == "shiftrs") return ops_.shift(op, a, b);
    if (operand != width_of(b)) fail(fmt::format("{}: '{}' on different widths", line_of(node), op));
    static const std::map<std::string_view, LaneOp> c_bitwise = {
        {"and", LaneOp::both}, {"or", LaneOp::either}, {"xor", LaneOp::differ}};
    if (const auto found = c_bitwise.find(op); found != c_bitwise.end()) {
      if (width == 1) {
        const int x = ops_.to_mask(a), y = ops_.to_mask(b);
        if (op == "and") {
          if (conditions_.implies(x, y)) return ops_.whole(x, 1);
          if (conditions_.implies(y, x)) return ops_.whole(y, 1);
        }
        return ops_.whole(graph().operate(found->second, x, y), 1);
      }
      Words words = ops_.to_words(a), others = ops_.to_words(b);
      for (std::size_t i = 0; i < words.size(); ++i)
        words[i] = graph().operate(found->second, words[i], others[i]);
      return ops_.from_words(words, width);
    }
    if (op == "add") return ops_.add(a, b);
    if (op == "sub") return ops_.difference(a, b);
    if (op == "mul" || op == "muls") return ops_.product(a, b);

    // Compare by a < b or a == b, with operands swapped or the result inverted.
    struct Order {
      LaneOp op;
      bool swap, invert;
    };
    static const std::map<std::string_view, Order> c_orders = {
        {"eq", {LaneOp::equal, false, false}},        {"neq", {LaneOp::equal, false, true}},
        {"lt", {LaneOp::less, false, false}},         {"gt", {LaneOp::less, true, false}},
        {"lte", {LaneOp::less, true, true}},          {"gte", {LaneOp::less, false, true}},
        {"lts", {LaneOp::signed_less, false, false}}, {"gts", {LaneOp::signed_less, true, false}},
        {"ltes", {LaneOp::signed_less, true, true}},  {"gtes", {LaneOp::signed_less, false, true}}};
    const auto found = c_orders.find(op);
    if (found == c_orders.end()) fail(fmt::format("{}: the lanes do not support '{}'", line_of(node), op));
    const Order order = found->second;
    int mask = 0;
    if (order.op == LaneOp::equal && operand == 1) {
      mask = graph().invert(graph().operate(LaneOp::differ, ops_.to_mask(a), ops_.to_mask(b)));
    } else {
      mask = order.swap ? ops_.compare(order.op, b, a) : ops_.compare(order.op, a, b);
    }
    return ops_.whole(order.invert ? graph().invert(mask) : mask, 1);
  }

  // Memories

  Bits element(pugi::xml_node node) {
    std::string name = node.first_child().attribute("name").value();
    // Verilator omits the module in the name of a memory that is read before it is declared.
    for (const auto& [whole, memory] : netlist_.memories)
      if (std::string_view(whole).substr(whole.find('.') + 1) == name) name = whole;
    if (const auto memory = netlist_.memories.find(name); memory != netlist_.memories.end())
      return read(node, name, memory->second);
    const auto rom = netlist_.roms.find(name);
    if (rom == netlist_.roms.end())
      fail(fmt::format("{}: {}: neither a table nor a memory", line_of(node), name));
    const Bits address = value(node.last_child());
    const unsigned width = width_of(address);
    if (width > 16 || rom->second.data.size() != std::size_t{1} << width)
      fail(fmt::format("{}: {}: an address that may be out of range", line_of(node), name));
    const int index = graph().clean(ops_.to_vector(address), width);
    Bits bits;
    for (const std::size_t table : rom->second.tables) {
      const unsigned more = std::min(rom->second.width - width_of(bits), c_lane_word);
      ops_.append(bits, ops_.whole(graph().rom(table, index, more), more));
    }
    return bits;
  }

  /// The address of an element. Fails if it may lie outside the memory.
  Bits address_of(pugi::xml_node node, const std::string& name, const LaneMemory& memory) {
    const Bits address = value(node.last_child());
    if (memory.places > c_most_places)
      fail(fmt::format("{}: {}: a memory of {} places: lanes have up to {}", line_of(node), name,
                       memory.places, c_most_places));
    if (memory.places != std::size_t{1} << width_of(address))
      fail(fmt::format("{}: {}: an address that may be out of range", line_of(node), name));
    return address;
  }

  Bits read(pugi::xml_node node, const std::string& name, const LaneMemory& memory) {
    const Bits address = address_of(node, name, memory);
    const int index = graph().clean(ops_.to_vector(address), width_of(address));
    Bits bits;
    for (std::size_t i = 0; i < memory.words(); ++i) {
      const std::size_t word = layout_.memory_words.at(name) + i;
      const unsigned low = static_cast<unsigned>(i) * c_lane_word;
      ops_.append(bits, {graph().word(graph().row(word / c_bank_words, index), word % c_bank_words), 0,
                         std::min(memory.width - low, c_lane_word)});
    }
    return bits;
  }

  void write(pugi::xml_node assignment, const LaneMemory& memory, const Guard& guard) {
    const pugi::xml_node target = assignment.last_child();
    const std::string name = target.first_child().attribute("name").value();
    const Bits address = address_of(target, name, memory), datum = value(assignment.first_child());
    const int index = graph().clean(ops_.to_vector(address), width_of(address));
    if (!step_.stores.try_emplace(name, Store{guard, index, ops_.to_words(datum, false)}).second)
      fail(fmt::format("{}: {}: written in two places", line_of(assignment), name));
  }

  // Statements

  void execute(pugi::xml_node node, const Guard& guard) {
    const std::string_view op = node.name();
    if (op == "begin") {
      for (const pugi::xml_node inner : node.children()) execute(inner, guard);
    } else if (op == "if") {
      const pugi::xml_node condition = node.first_child(), then_part = condition.next_sibling();
      const int mask = ops_.to_mask(value(condition));
      if (const auto narrower = narrow(guard, mask, true)) execute(then_part, *narrower);
      if (const auto other = narrow(guard, mask, false); other && then_part.next_sibling())
        execute(then_part.next_sibling(), *other);
    } else if (op == "assigndly" && std::string_view(node.last_child().name()) == "varref") {
      assign(node, node.last_child().attribute("name").value(), value(node.first_child()), guard);
    } else if (const auto memory =
                   netlist_.memories.find(node.last_child().first_child().attribute("name").value());
               op == "assigndly" && memory != netlist_.memories.end()) {
      write(node, memory->second, guard);
    } else {
      fail(fmt::format("{}: the lanes do not support '{}' in a clocked block", line_of(node), op));
    }
  }

  std::optional<Guard> narrow(const Guard& guard, int mask, bool wanted) {
    return halfway::narrow(graph(), guard, mask, wanted);
  }

  void assign(pugi::xml_node node, const std::string& name, const Bits& bits, const Guard& guard) {
    if (layout_.twins.count(name) != 0) return;
    Assignments& assignments = step_.assignments[name];
    for (const auto& other : assignments) {
      if (!excludes(guard, other.first)) fail(fmt::format("{}: {}: assigned twice", line_of(node), name));
    }
    assignments.emplace_back(guard, bits);
    unsigned at = 0;
    for (const Piece& piece : bits) layout_.cuts[name].insert(at += piece.width);
    for (std::size_t i = first_cell_[name]; i < step_.cells.size() && step_.cells[i].signal == name; ++i) {
      const Cell& cell = step_.cells[i];
      const Bits whole = ops_.slice(bits, cell.low, cell.width);
      for (const auto& [when, part] : loads_of(step_, ops_, conditions_, i, whole, guard)) {
        int next = cell.mask ? ops_.to_mask(part) : ops_.to_vector(part, false);
        if (!cell.mask && (cell.width == 1 || layout_.cleaned.count({name, cell.low}) != 0))
          next = graph().clean(next, cell.width);
        if (!cell.mask && graph()[next].bits > cell.width) layout_.dirty.insert({name, cell.low});
        step_.updates[when].push_back({i, next});
      }
    }
  }

  const LaneNetlist& netlist_;
  const LanePorts& ports_;
  bool reset_;
  CellLayout& layout_;
  Step step_;
  BitOperations ops_{step_, layout_};
  KnownConditions conditions_{step_.graph};
  std::map<std::string, std::size_t> first_cell_;                ///< by register or input
  std::map<std::string, Bits> signals_;                          ///< those known; empty: being built
  std::set<std::tuple<std::string, unsigned, unsigned>> parts_;  ///< slices being built
};

}  // namespace

Step build_step(const LaneNetlist& netlist, const LanePorts& ports, bool reset, CellLayout& layout) {
  return GraphBuilder(netlist, ports, reset, layout).build();
}

}  // namespace halfway

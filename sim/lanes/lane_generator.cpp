// SPDX-License-Identifier: Apache-2.0
#include "sim/lanes/lane_generator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <pugixml.hpp>
#include <set>
#include <utility>

#include "sim/lanes/lane_graph.hpp"

namespace halfway {
namespace {

constexpr unsigned kWord = kLaneWord;

constexpr std::size_t kRow = 4;  ///< words of a bank's place

constexpr std::uint64_t ones(unsigned width) {
  return (std::uint64_t{1} << std::min(width, kWord)) - 1;
}

/// `width` bits of a vector from `low` up, or a mask repeated. A signal is a list of pieces, the least
/// significant first: slices, concatenations and extensions only rearrange them.
struct Piece {
  int node;
  unsigned low, width;
  friend auto operator<=>(const Piece&, const Piece&) = default;
};
using Bits = std::vector<Piece>;
using Words = std::vector<int>;  ///< vectors that are one number, the least significant first

unsigned width_of(const Bits& bits) {
  unsigned width = 0;
  for (const Piece& piece : bits) width += piece.width;
  return width;
}

struct Rom {
  unsigned bits = 0;  ///< of a datum
  std::vector<std::uint64_t> data;
};

/// A memory that is written. Its places lie in rows of words, a bank for each four words; memories that are
/// written together share a bank.
struct Memory {
  unsigned bits = 0;  ///< of a datum
  std::size_t places = 0;
  std::size_t words() const { return (bits + kWord - 1) / kWord; }
};
constexpr std::size_t kMostPlaces = 1024;  ///< each lane has its own

/// The netlist by names. The nodes stay in the document.
struct Netlist {
  std::map<std::string, unsigned> types;                             ///< width by the type's number
  std::map<std::string, std::pair<std::string, std::size_t>> rooms;  ///< array types: element type, count
  std::map<std::string, unsigned> inputs;                            ///< width
  std::map<std::string, pugi::xml_node> drivers;                     ///< the expression assigned
  std::map<std::string, unsigned> registers;                         ///< width
  std::vector<pugi::xml_node> clocked;                               ///< the statements of `always` blocks
  std::map<std::string, Rom> roms;
  std::map<std::string, Memory> memories;
};

/// A part of a register or an input, of up to a word's bits, that lies in a variable of its own.
struct Cell {
  std::string variable;
  unsigned low, width;
  bool input, dirty;  ///< dirty: bits above `width` mean nothing
  bool mask;
};

using Rooms = std::map<std::string, std::size_t>;  ///< a memory's first word, counted through all banks

/// How registers and inputs are cut into cells, found by building the graph until nothing new is asked for:
/// where a slice begins or ends there is a cut, but none inside what arithmetic takes as a whole.
struct Layout {
  std::map<std::string, std::set<unsigned>> cuts;
  std::map<std::string, std::set<std::pair<unsigned, unsigned>>> wholes;
  std::set<std::pair<std::string, unsigned>> dirty;
  std::set<std::pair<std::string, unsigned>> cleaned;  ///< would be dirty, but who reads them minds
  std::map<std::string, std::string> twins;            ///< registers that are always what another one is
  std::set<std::pair<std::string, unsigned>> numbers;  ///< of one bit, but no masks: sums take them
  Rooms rooms;
  bool words = false;  ///< cells have a word at most; at first they are not cut where nothing asks for it
  friend bool operator==(const Layout&, const Layout&) = default;

  std::vector<Cell> cells_of(const std::string& variable, unsigned width, bool input) const {
    std::set<unsigned> at = {0, width};
    if (const auto found = cuts.find(variable); found != cuts.end())
      at.insert(found->second.begin(), found->second.end());
    if (const auto found = wholes.find(variable); found != wholes.end())
      for (const auto& [low, high] : found->second) at.erase(at.upper_bound(low), at.lower_bound(high));
    std::vector<Cell> cells;
    for (auto next = at.begin(); *next != width;) {
      const unsigned begin = *next++;
      const unsigned longest = words ? kWord : *next - begin;
      for (unsigned low = begin; low < *next; low += longest) {
        const unsigned bits = std::min(*next - low, longest);
        cells.push_back({variable, low, bits, input,
                         !input && dirty.count({variable, low}) != 0 && cleaned.count({variable, low}) == 0,
                         bits == 1 && numbers.count({variable, low}) == 0});
      }
    }
    return cells;
  }
};

/// A condition: masks that are all true, or false.
using Guard = std::set<std::pair<int, bool>>;

/// Whether a condition stands for both its operands, which are in a guard beside it.
bool has_parts(const LaneNode& mask, bool wanted) {
  return mask.op == (wanted ? LaneOp::mask_both : LaneOp::mask_either);
}

bool excludes(const Guard& a, const Guard& b) {
  return std::any_of(a.begin(), a.end(), [&](const auto& literal) {
    return b.count({literal.first, !literal.second}) != 0;
  });
}

struct Update {
  std::size_t cell;
  int value;
};

/// What a place of a memory, or of a bank, becomes.
struct Store {
  Guard guard;
  int address;
  Words words;
};
/// Among the cells that a group reads and writes: banks come behind them.
constexpr std::size_t kFirstBank = std::size_t{1} << 32;

/// What a register becomes, and when: registers for which it is the same are twins.
using Writes = std::vector<std::pair<Guard, Bits>>;

/// One function: the graph for one value of `reset`.
struct Step {
  LaneGraph graph;
  std::vector<Cell> cells;
  std::map<Guard, std::vector<Update>> updates;
  std::map<std::string, Store> stores;              ///< by memory
  std::map<std::string, std::vector<int>> outputs;  ///< words, or one mask
  std::map<std::string, Writes> writes;
};

class Builder {
 public:
  Builder(const Netlist& netlist, const LanePorts& ports, bool reset, Layout& layout)
      : netlist_(netlist), ports_(ports), reset_(reset), layout_(layout) {
    for (const auto& [variables, input] : {std::pair(&netlist.inputs, true), {&netlist.registers, false}}) {
      for (const auto& [name, width] : *variables) {
        if (layout.twins.count(name) != 0) continue;
        first_cell_[name] = step_.cells.size();
        for (Cell& cell : layout.cells_of(name, width, input)) step_.cells.push_back(std::move(cell));
      }
    }
  }

  Result<Step> build() {
    for (const std::string& name : ports_.outputs) {
      const Bits bits = signal(name);
      auto& words = step_.outputs[name];
      const unsigned width = width_of(bits);
      if (width == 1) {
        words.push_back(to_mask(bits));
      } else {
        if (bits.empty()) continue;
        words = to_words(bits, false);
        words.back() = graph().clean(words.back(), top_width(width));
      }
    }
    for (const pugi::xml_node statement : netlist_.clocked) execute(statement, {});
    if (!error_.empty()) return tool_failed(error_);
    return std::move(step_);
  }

 private:
  LaneGraph& graph() { return step_.graph; }

  Bits fail(const std::string& what) {
    if (error_.empty()) error_ = what;
    return {};
  }
  static std::string line_of(pugi::xml_node node) {
    const std::string_view place = node.attribute("loc").value();
    const std::size_t comma = place.find(',');
    if (comma == std::string_view::npos) return "netlist.v";
    return "netlist.v:" + std::string(place.substr(comma + 1, place.find(',', comma + 1) - comma - 1));
  }
  unsigned type_width(pugi::xml_node node) {
    const auto found = netlist_.types.find(node.attribute("dtype_id").value());
    return found == netlist_.types.end() ? 0 : found->second;
  }

  // Pieces

  bool is_mask(const Piece& piece) { return graph()[piece.node].is_mask(); }

  /// A piece of a constant; what lies above a node's vector is zero.
  std::uint64_t constant_of(const Piece& piece) {
    return piece.low < kWord ? graph()[piece.node].value >> piece.low & ones(piece.width) : 0;
  }

  void append(Bits& bits, Piece piece) {
    if (piece.width == 0) return;
    if (!bits.empty()) {
      Piece& last = bits.back();
      const LaneNode &a = graph()[last.node], &b = graph()[piece.node];
      if (last.node == piece.node && (a.is_mask() || piece.low == last.low + last.width)) {
        last.width += piece.width;
        return;
      }
      if (a.op == LaneOp::constant && b.op == LaneOp::constant && last.width + piece.width <= kWord) {
        const std::uint64_t low = constant_of(last), high = constant_of(piece);
        last = {graph().constant(low | high << last.width), 0, last.width + piece.width};
        return;
      }
    }
    bits.push_back(piece);
  }
  void append(Bits& bits, const Bits& more) {
    for (const Piece& piece : more) append(bits, piece);
  }

  Bits slice(const Bits& bits, unsigned low, unsigned width) {
    Bits found;
    unsigned at = 0;
    for (const Piece& piece : bits) {
      const unsigned begin = std::max(low, at), end = std::min(low + width, at + piece.width);
      if (begin < end) append(found, {piece.node, is_mask(piece) ? 0 : piece.low + begin - at, end - begin});
      at += piece.width;
    }
    if (width_of(found) != width) return fail("a slice reaches past its signal");
    return found;
  }

  Bits whole(int node, unsigned width) { return {{node, 0, width}}; }
  Bits constant(std::uint64_t value, unsigned width) { return whole(graph().constant(value), width); }
  Bits zeros(unsigned width) {
    Bits bits;
    for (unsigned low = 0; low < width; low += kWord)
      bits.push_back({graph().constant(0), 0, std::min(width - low, kWord)});
    return bits;
  }

  void note(const Piece& piece, bool arithmetic) {
    const LaneNode& node = graph()[piece.node];
    if (node.op != LaneOp::cell) return;
    const Cell& cell = step_.cells[node.value];
    const unsigned low = cell.low + piece.low, high = low + piece.width;
    layout_.cuts[cell.variable].insert({low, high});
    if (arithmetic) layout_.wholes[cell.variable].insert({low, high});
  }

  /// Nothing must lie above this: if it is a whole cell, better there than wherever that is read.
  void note_clean(const Piece& piece) {
    const LaneNode& node = graph()[piece.node];
    if (node.op != LaneOp::cell) return;
    const Cell& cell = step_.cells[node.value];
    if (cell.dirty && cell.width == piece.width) layout_.cleaned.insert({cell.variable, cell.low});
  }

  /// As one vector; what lies above the bits' width means nothing.
  int to_vector(const Bits& bits, bool arithmetic = true) {
    int sum = graph().constant(0);
    std::uint64_t constants = 0;
    unsigned at = 0;
    const unsigned width = width_of(bits);
    for (const Piece& piece : bits) note(piece, arithmetic);
    // A register that is not cut yet: what is noted cuts it, and the nodes are made anew.
    if (width > kWord) {
      if (layout_.words) fail(fmt::format("netlist.v: {} bits in one vector", width));
      return sum;
    }
    for (const Piece& piece : bits) {
      const std::uint64_t field = ones(piece.width) << at;
      const LaneNode& node = graph()[piece.node];
      if (node.is_mask()) {
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

  /// As vectors of a word each, the least significant first.
  Words to_words(const Bits& bits, bool arithmetic = true) {
    Words words;
    const unsigned width = width_of(bits);
    for (const Piece& piece : bits) note(piece, arithmetic);
    for (unsigned low = 0; low < width; low += kWord)
      words.push_back(to_vector(slice(bits, low, std::min(width - low, kWord)), arithmetic));
    return words;
  }
  Bits from_words(const Words& words, unsigned width) {
    Bits bits;
    for (unsigned low = 0; low < width; low += kWord)
      append(bits, {words[low / kWord], 0, std::min(width - low, kWord)});
    return bits;
  }
  /// Bits of the last word.
  static unsigned top_width(unsigned width) { return (width - 1) % kWord + 1; }

  int to_mask(const Bits& bits) {
    if (bits.empty()) return graph().mask_constant(false);
    const Piece& piece = bits.front();
    if (is_mask(piece)) return piece.node;
    note(piece, false);
    return graph().bit(piece.node, piece.low);
  }

  Bits choose(int mask, const Bits& a, const Bits& b) {
    Bits chosen;
    const unsigned width = width_of(a);
    std::set<unsigned> cuts;
    for (const Bits* bits : {&a, &b}) {
      unsigned at = 0;
      for (const Piece& piece : *bits) cuts.insert(at += piece.width);
    }
    unsigned low = 0;
    for (const unsigned high : cuts) {
      if (high > width) break;
      const Bits p = slice(a, low, high - low), q = slice(b, low, high - low);
      low = high;
      if (p.empty() || q.empty()) return {};
      const Piece &x = p[0], &y = q[0];
      if (x.width == 1 || (is_mask(x) && is_mask(y))) {
        const int then_mask = graph().mask_operate(LaneOp::mask_both, mask, to_mask(p));
        const int else_mask = graph().mask_operate(LaneOp::mask_both, graph().mask_invert(mask), to_mask(q));
        append(chosen, {graph().mask_operate(LaneOp::mask_either, then_mask, else_mask), 0, x.width});
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

  // Expressions

  Bits signal(const std::string& name) {
    if (const auto known = signals_.find(name); known != signals_.end()) {
      if (known->second.empty()) return fail(name + ": depends on itself without a register");
      return known->second;
    }
    if (const auto fixed = ports_.fixed.find(name); fixed != ports_.fixed.end())
      return whole(graph().mask_constant(fixed->second), 1);
    if (name == "reset") return whole(graph().mask_constant(reset_), 1);
    if (const auto twin = layout_.twins.find(name); twin != layout_.twins.end()) return signal(twin->second);
    if (const auto cells = first_cell_.find(name); cells != first_cell_.end()) {
      Bits bits;
      for (std::size_t i = cells->second; i < step_.cells.size() && step_.cells[i].variable == name; ++i) {
        const Cell& cell = step_.cells[i];
        const unsigned known = cell.dirty ? std::max(cell.width, kWord) : cell.width;
        bits.push_back({cell.mask ? graph().mask_cell(i) : graph().cell(i, known), 0, cell.width});
      }
      return bits;
    }
    const auto driver = netlist_.drivers.find(name);
    if (driver == netlist_.drivers.end()) return fail(name + ": nothing that the lanes know drives this");
    signals_[name] = {};
    return signals_[name] = value(driver->second);
  }

  Bits literal(pugi::xml_node node) {
    const unsigned width = type_width(node);
    std::string_view digits = node.attribute("name").value();
    const std::size_t quote = digits.find('\'');
    if (quote == std::string_view::npos) return fail(line_of(node) + ": a constant without a base");
    digits.remove_prefix(quote + 1);
    if (digits.substr(0, 1) == "s") digits.remove_prefix(1);
    const unsigned step = digits.substr(0, 1) == "h" ? 4 : digits.substr(0, 1) == "b" ? 1 : 0;
    if (step == 0) return fail(line_of(node) + ": a constant of an unknown base");
    digits.remove_prefix(1);
    std::vector<std::uint64_t> words(width / kWord + 1);
    unsigned at = 0;
    for (auto digit = digits.rbegin(); digit != digits.rend() && at < width; ++digit, at += step) {
      // Unknown bits are zeros, as Verilator has them with --x-assign fast.
      const std::size_t found = std::string_view("0123456789abcdef").find(*digit);
      words[at / kWord] |= (found == std::string_view::npos ? 0 : std::uint64_t{found}) << at % kWord;
    }
    Bits bits;
    for (unsigned low = 0; low < width; low += kWord)
      append(bits, constant(words[low / kWord], std::min(width - low, kWord)));
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
    const unsigned width = type_width(node);
    const pugi::xml_node first = node.first_child(), second = first.next_sibling();
    if (!first) return fail(fmt::format("{}: the lanes do not know '{}'", line_of(node), op));
    if (op == "arraysel") return element(node);
    const Bits a = value(first);
    if (a.empty()) return {};
    if (op == "sel") {
      const auto low = number(second), count = number(second.next_sibling());
      if (!low || !count) return fail(line_of(node) + ": a slice whose place is not constant");
      return slice(a, static_cast<unsigned>(*low), static_cast<unsigned>(*count));
    }
    if (op == "extend" || op == "extends") {
      if (width_of(a) > width) return fail(line_of(node) + ": an extension that narrows");
      Bits bits = a;
      const unsigned more = width - width_of(a);
      append(bits, op == "extend" ? zeros(more) : whole(to_mask(slice(a, width_of(a) - 1, 1)), more));
      return bits;
    }
    if (op == "not") return invert(a);
    if (op == "negate") return difference(zeros(width), a);
    if (op == "replicate") {
      const auto count = number(second);
      if (!count) return fail(line_of(node) + ": a replication whose count is not constant");
      Bits bits;
      if (width_of(a) == 1) return whole(to_mask(a), static_cast<unsigned>(*count));
      for (std::uint64_t i = 0; i < *count; ++i) append(bits, a);
      return bits;
    }
    if (!second) return fail(fmt::format("{}: the lanes do not know '{}'", line_of(node), op));
    const Bits b = value(second);
    if (b.empty()) return {};
    if (op == "concat") {
      Bits bits = b;
      append(bits, a);
      return bits;
    }
    if (op == "cond") {
      const Bits c = value(second.next_sibling());
      return c.empty() ? c : choose(to_mask(a), b, c);
    }
    return binary(node, op, a, b);
  }

  Bits invert(const Bits& a) {
    const unsigned width = width_of(a);
    if (width == 1) return whole(graph().mask_invert(to_mask(a)), 1);
    Words words = to_words(a);
    for (int& word : words) word = graph().invert(word);
    return from_words(words, width);
  }

  // Sums and products of any number of words: a carry is a mask, or a number of one bit.

  /// `carry`: a mask, or a number of one bit.
  Bits sum(const Bits& a, const Bits& b, int carry) {
    const Words x = to_words(a), y = to_words(b);
    Words words;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const int part = graph().operate(LaneOp::add, x[i], y[i]);
      words.push_back(
          graph().operate(LaneOp::add, part, graph()[carry].is_mask() ? graph().fill(carry, 1) : carry));
      if (i + 1 == x.size()) break;
      if (!graph()[carry].is_mask()) carry = graph().bit(carry, 0);
      const int wraps = graph().compare(LaneOp::equal, words.back(), graph().constant(0));
      carry = graph().mask_operate(LaneOp::mask_either, graph().compare(LaneOp::less, part, x[i]),
                                   graph().mask_operate(LaneOp::mask_both, carry, wraps));
    }
    return from_words(words, width_of(a));
  }
  Bits difference(const Bits& a, const Bits& b) {
    const unsigned width = width_of(a);
    if (width <= kWord) return whole(graph().operate(LaneOp::subtract, to_vector(a), to_vector(b)), width);
    return sum(a, invert(b), graph().mask_constant(true));
  }
  Bits product(const Bits& a, const Bits& b) {
    const unsigned width = width_of(a);
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

  /// The lowest bit alone, a constant one.
  bool is_one(const Bits& bits) {
    const Piece& low = bits.front();
    const LaneNode& node = graph()[low.node];
    return low.width == 1 && node.op == LaneOp::constant && (node.value >> low.low & 1) != 0;
  }
  /// (x, 1) + (y, carry), as the RTL takes a carry by one sum: x + y + carry behind the bit that makes it.
  Bits sum_with_carry(const Bits& a, const Bits& b) {
    const unsigned width = width_of(a) - 1;
    const Bits carry = slice(b, 0, 1);
    Bits bits = whole(graph().mask_invert(to_mask(carry)), 1);
    int node = carry.front().node;
    if (const LaneNode& at = graph()[node]; at.op == LaneOp::mask_cell && !step_.cells[at.value].input)
      layout_.numbers.insert({step_.cells[at.value].variable, step_.cells[at.value].low});
    else if (at.op != LaneOp::cell || at.bits != 1)
      node = to_mask(carry);
    append(bits, sum(slice(a, 1, width), slice(b, 1, width), node));
    return bits;
  }

  Bits binary(pugi::xml_node node, std::string_view op, const Bits& a, const Bits& b) {
    const unsigned width = type_width(node), operand = width_of(a);
    if (op == "shiftl" || op == "shiftr" || op == "shiftrs") return shift(op, a, b);
    if (operand != width_of(b)) return fail(fmt::format("{}: '{}' on different widths", line_of(node), op));
    static const std::map<std::string_view, std::pair<LaneOp, LaneOp>> bitwise = {
        {"and", {LaneOp::both, LaneOp::mask_both}},
        {"or", {LaneOp::either, LaneOp::mask_either}},
        {"xor", {LaneOp::differ, LaneOp::mask_differ}}};
    if (const auto found = bitwise.find(op); found != bitwise.end()) {
      if (width == 1) return whole(graph().mask_operate(found->second.second, to_mask(a), to_mask(b)), 1);
      Words words = to_words(a), others = to_words(b);
      for (std::size_t i = 0; i < words.size(); ++i)
        words[i] = graph().operate(found->second.first, words[i], others[i]);
      return from_words(words, width);
    }
    if (op == "add" && width > 1 && operand == width) {
      if (is_one(a)) return sum_with_carry(a, b);
      if (is_one(b)) return sum_with_carry(b, a);
    }
    if (op == "add") return sum(a, b, graph().mask_constant(false));
    if (op == "sub") return difference(a, b);
    if (op == "mul" || op == "muls") return product(a, b);

    // a OP b as a < b or a == b, perhaps the other way round, perhaps not.
    struct Order {
      LaneOp op;
      bool swap, invert;
    };
    static const std::map<std::string_view, Order> orders = {
        {"eq", {LaneOp::equal, false, false}},        {"neq", {LaneOp::equal, false, true}},
        {"lt", {LaneOp::less, false, false}},         {"gt", {LaneOp::less, true, false}},
        {"lte", {LaneOp::less, true, true}},          {"gte", {LaneOp::less, false, true}},
        {"lts", {LaneOp::signed_less, false, false}}, {"gts", {LaneOp::signed_less, true, false}},
        {"ltes", {LaneOp::signed_less, true, true}},  {"gtes", {LaneOp::signed_less, false, true}}};
    const auto found = orders.find(op);
    if (found == orders.end()) return fail(fmt::format("{}: the lanes do not know '{}'", line_of(node), op));
    const Order order = found->second;
    int mask = 0;
    if (order.op == LaneOp::equal && operand == 1) {
      mask = graph().mask_invert(graph().mask_operate(LaneOp::mask_differ, to_mask(a), to_mask(b)));
    } else {
      mask = order.swap ? compare(order.op, b, a) : compare(order.op, a, b);
    }
    return whole(order.invert ? graph().mask_invert(mask) : mask, 1);
  }

  /// The uppermost word that differs says which is less.
  int compare(LaneOp op, const Bits& a, const Bits& b) {
    const unsigned top = top_width(width_of(a));
    Words x = to_words(a), y = to_words(b);
    for (Words* words : {&x, &y}) {
      // The sign at the top, or nothing above the number.
      int& last = words->back();
      last = op == LaneOp::signed_less ? graph().shift(last, static_cast<int>(kWord - top))
                                       : graph().clean(last, top);
    }
    int mask = graph().mask_constant(op == LaneOp::equal);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const int same =
          graph().mask_operate(LaneOp::mask_both, graph().compare(LaneOp::equal, x[i], y[i]), mask);
      const LaneOp here = op == LaneOp::signed_less && i + 1 < x.size() ? LaneOp::less : op;
      mask = op == LaneOp::equal
                 ? same
                 : graph().mask_operate(LaneOp::mask_either, graph().compare(here, x[i], y[i]), same);
    }
    return mask;
  }

  /// By a constant.
  Bits moved(std::string_view op, const Bits& a, unsigned distance) {
    const unsigned width = width_of(a), kept = width - distance;
    Bits bits = op == "shiftl" ? zeros(distance) : slice(a, distance, kept);
    append(bits, op == "shiftl"   ? slice(a, 0, kept)
                 : op == "shiftr" ? zeros(distance)
                                  : whole(to_mask(slice(a, width - 1, 1)), distance));
    return bits;
  }

  Bits shift(std::string_view op, const Bits& a, const Bits& by) {
    const unsigned width = width_of(a);
    if (by.size() == 1 && graph()[by[0].node].op == LaneOp::constant)
      return moved(op, a, static_cast<unsigned>(std::min<std::uint64_t>(graph()[by[0].node].value, width)));
    if (width > kWord) {
      Bits bits = a;
      for (unsigned bit = 0; bit < width_of(by); ++bit) {
        const unsigned distance = std::min(width, 1U << std::min(bit, kWord - 1));
        bits = choose(to_mask(slice(by, bit, 1)), moved(op, bits, distance), bits);
        bits = from_words(to_words(bits), width);
      }
      return bits;
    }
    const int distance = graph().clean(to_vector(by), width_of(by));
    int vector = to_vector(a);
    if (op == "shiftl") return whole(graph().operate(LaneOp::left_by, vector, distance), width);
    if (op == "shiftr")
      return whole(graph().operate(LaneOp::right_by, graph().clean(vector, width), distance), width);
    vector = graph().shift(vector, static_cast<int>(kWord - width));
    vector = graph().operate(LaneOp::signed_right_by, vector, graph().constant(kWord - width));
    return whole(graph().operate(LaneOp::signed_right_by, vector, distance), width);
  }

  Bits element(pugi::xml_node node) {
    std::string name = node.first_child().attribute("name").value();
    // Where it is read before it is declared Verilator leaves the module out of its name.
    for (const auto& [whole, memory] : netlist_.memories)
      if (std::string_view(whole).substr(whole.find('.') + 1) == name) name = whole;
    if (const auto memory = netlist_.memories.find(name); memory != netlist_.memories.end())
      return read(node, name, memory->second);
    const auto rom = netlist_.roms.find(name);
    if (rom == netlist_.roms.end())
      return fail(fmt::format("{}: {}: nothing that the lanes know is in there", line_of(node), name));
    const Bits address = value(node.last_child());
    const unsigned width = width_of(address);
    if (width > 16 || rom->second.data.size() != std::size_t{1} << width)
      return fail(fmt::format("{}: {}: an address that may lie outside", line_of(node), name));
    // Equal tables are one.
    const auto first = std::find_if(netlist_.roms.begin(), netlist_.roms.end(),
                                    [&](const auto& other) { return other.second.data == rom->second.data; });
    const auto table = static_cast<std::size_t>(std::distance(netlist_.roms.begin(), first));
    return whole(graph().rom(table, graph().clean(to_vector(address), width), rom->second.bits),
                 rom->second.bits);
  }

  /// The place that the element `node` names, as a mask's bits; nothing where it may lie outside.
  Bits address_of(pugi::xml_node node, const std::string& name, const Memory& memory) {
    const Bits address = value(node.last_child());
    if (address.empty()) return {};
    if (memory.places > kMostPlaces)
      return fail(fmt::format("{}: {}: a memory of {} places: lanes have up to {}", line_of(node), name,
                              memory.places, kMostPlaces));
    if (memory.places != std::size_t{1} << width_of(address))
      return fail(fmt::format("{}: {}: an address that may lie outside", line_of(node), name));
    return address;
  }

  Bits read(pugi::xml_node node, const std::string& name, const Memory& memory) {
    const Bits address = address_of(node, name, memory);
    if (address.empty()) return {};
    const int index = graph().clean(to_vector(address), width_of(address));
    Bits bits;
    for (std::size_t i = 0; i < memory.words(); ++i) {
      const std::size_t word = layout_.rooms.at(name) + i;
      const unsigned low = static_cast<unsigned>(i) * kWord;
      append(bits, {graph().word(graph().row(word / kRow, index), word % kRow), 0,
                    std::min(memory.bits - low, kWord)});
    }
    return bits;
  }

  void write(pugi::xml_node assignment, const Memory& memory, const Guard& guard) {
    const pugi::xml_node target = assignment.last_child();
    const std::string name = target.first_child().attribute("name").value();
    const Bits address = address_of(target, name, memory), datum = value(assignment.first_child());
    if (address.empty() || datum.empty()) return;
    const int index = graph().clean(to_vector(address), width_of(address));
    if (!step_.stores.try_emplace(name, Store{guard, index, to_words(datum, false)}).second)
      fail(fmt::format("{}: {}: written in two places", line_of(assignment), name));
  }

  // Statements

  /// With one more condition, and its parts; nothing where it can never hold.
  std::optional<Guard> narrow(Guard guard, int mask, bool wanted) {
    const LaneNode node = graph()[mask];
    if (node.op == LaneOp::mask_constant)
      return (node.value != 0) == wanted ? std::optional(std::move(guard)) : std::nullopt;
    if (node.op == LaneOp::mask_invert) return narrow(std::move(guard), node.operands[0], !wanted);
    if (guard.count({mask, !wanted}) != 0) return std::nullopt;
    guard.insert({mask, wanted});
    if (!has_parts(node, wanted)) return guard;
    auto narrower = narrow(std::move(guard), node.operands[0], wanted);
    return narrower ? narrow(std::move(*narrower), node.operands[1], wanted) : std::nullopt;
  }

  void execute(pugi::xml_node node, const Guard& guard) {
    const std::string_view op = node.name();
    if (op == "begin") {
      for (const pugi::xml_node inner : node.children()) execute(inner, guard);
    } else if (op == "if") {
      const pugi::xml_node condition = node.first_child(), then_part = condition.next_sibling();
      const int mask = to_mask(value(condition));
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
      fail(fmt::format("{}: the lanes do not know '{}' there", line_of(node), op));
    }
  }

  void assign(pugi::xml_node node, const std::string& name, const Bits& bits, const Guard& guard) {
    if (layout_.twins.count(name) != 0) return;
    Writes& writes = step_.writes[name];
    for (const auto& other : writes) {
      if (!excludes(guard, other.first)) fail(fmt::format("{}: {}: assigned twice", line_of(node), name));
    }
    writes.emplace_back(guard, bits);
    if (!error_.empty()) return;
    unsigned at = 0;
    for (const Piece& piece : bits) layout_.cuts[name].insert(at += piece.width);
    for (std::size_t i = first_cell_[name]; i < step_.cells.size() && step_.cells[i].variable == name; ++i) {
      const Cell& cell = step_.cells[i];
      const Bits part = slice(bits, cell.low, cell.width);
      int next = cell.mask ? to_mask(part) : to_vector(part, false);
      if (!cell.mask && (cell.width == 1 || layout_.cleaned.count({name, cell.low}) != 0))
        next = graph().clean(next, cell.width);
      if (!cell.mask && graph()[next].bits > cell.width) layout_.dirty.insert({name, cell.low});
      step_.updates[guard].push_back({i, next});
    }
  }

  const Netlist& netlist_;
  const LanePorts& ports_;
  bool reset_;
  Layout& layout_;
  Step step_;
  std::map<std::string, std::size_t> first_cell_;
  std::map<std::string, Bits> signals_;
  std::string error_;
};

// Registers that only delay others: a ring of places, one a clock, in which nothing moves.

struct Ring {
  std::size_t head;  ///< the cell that is written
  unsigned age;      ///< clocks behind it
};
using Rings = std::map<std::size_t, Ring>;     ///< by cell
constexpr unsigned kRingPlaces = 8;            ///< a power of two
constexpr unsigned kOldest = kRingPlaces - 2;  ///< the place beyond is being written

/// What a cell becomes at each edge in both steps; nothing where that depends.
std::optional<std::pair<int, int>> always_becomes(const Step& step, const Step& reset_step,
                                                  std::size_t cell) {
  std::array<std::optional<int>, 2> values;
  for (std::size_t i = 0; i < 2; ++i) {
    for (const auto& [guard, updates] : (i == 0 ? step : reset_step).updates) {
      for (const Update& update : updates) {
        if (update.cell != cell) continue;
        if (!guard.empty()) return std::nullopt;
        values[i] = update.value;
      }
    }
  }
  if (!values[0] || !values[1]) return std::nullopt;
  return std::pair(*values[0], *values[1]);
}

Rings find_rings(const Step& step, const Step& reset_step, const std::set<std::size_t>& live) {
  std::map<std::size_t, std::vector<std::size_t>> followers;
  std::set<std::size_t> always;
  for (const std::size_t cell : live) {
    if (cell >= kFirstBank || step.cells[cell].input || step.cells[cell].mask) continue;
    const auto values = always_becomes(step, reset_step, cell);
    if (!values) continue;
    always.insert(cell);
    const LaneNode &a = step.graph[values->first], &b = reset_step.graph[values->second];
    if (a.op == LaneOp::cell && b.op == LaneOp::cell && a.value == b.value)
      followers[a.value].push_back(cell);
  }
  std::set<std::size_t> heads = always;
  for (const auto& [source, cells] : followers)
    if (always.count(source) != 0)
      for (const std::size_t cell : cells) heads.erase(cell);
  Rings rings;
  const std::function<void(std::size_t, Ring)> add = [&](std::size_t cell, Ring ring) {
    if (ring.age > kOldest) ring = {cell, 0};
    if (const auto found = followers.find(cell); found != followers.end())
      for (const std::size_t follower : found->second) add(follower, {ring.head, ring.age + 1});
    if (ring.age > 0 || followers.count(cell) != 0) rings[cell] = ring;
  };
  for (const std::size_t head : heads) add(head, {head, 0});
  return rings;
}

// The text

struct Group {
  Guard guard;
  std::vector<Update> updates;
  std::map<std::size_t, Store> banks;  ///< what their places become
  int mask;
  std::set<std::size_t> reads, writes;
};

class Writer {
 public:
  Writer(Step& step, const Rooms& rooms, const std::set<std::size_t>& live, const Rings& rings)
      : step_(step), live_(live), rings_(rings) {
    for (const auto& [guard, updates] : step.updates) {
      Group group{guard, {}, {}, mask_of(guard), {}, {}};
      for (const Update& update : updates)
        if (live.count(update.cell) != 0 && !is_late(update.cell)) group.updates.push_back(update);
      put_masks_last(group);
      if (!group.updates.empty()) groups_.push_back(std::move(group));
    }
    for (const auto& [guard, banks] : banks_of(step, rooms)) {
      Group group{guard, {}, {}, mask_of(guard), {}, {}};
      for (const auto& [bank, store] : banks)
        if (live.count(kFirstBank + bank) != 0) group.banks.emplace(bank, store);
      if (!group.banks.empty()) groups_.push_back(std::move(group));
    }
  }

  /// The memories' words as they lie in banks.
  static std::map<Guard, std::map<std::size_t, Store>> banks_of(const Step& step, const Rooms& rooms) {
    std::map<Guard, std::map<std::size_t, Store>> banks;
    for (const auto& [name, store] : step.stores) {
      for (std::size_t i = 0; i < store.words.size(); ++i) {
        const std::size_t word = rooms.at(name) + i;
        Store& bank = banks[store.guard][word / kRow];
        bank.address = store.address;
        bank.words.resize(kRow, store.words[0]);
        bank.words[word % kRow] = store.words[i];
      }
    }
    return banks;
  }

  /// The cells that the outputs depend on, over any number of clocks.
  static std::set<std::size_t> live_cells(const Step& step, const Rooms& rooms) {
    std::vector<bool> seen(static_cast<std::size_t>(step.graph.size()));
    std::set<std::size_t> live;
    const auto see = [&](int node) { visit(step.graph, node, seen, live); };
    for (const auto& [name, words] : step.outputs)
      for (const int word : words) see(word);
    for (std::size_t before = SIZE_MAX; before != live.size();) {
      before = live.size();
      for (const auto& [guard, updates] : step.updates) {
        for (const Update& update : updates) {
          if (live.count(update.cell) == 0) continue;
          see(update.value);
          for (const auto& literal : guard) see(literal.first);
        }
      }
      for (const auto& [guard, banks] : banks_of(step, rooms)) {
        for (const auto& [bank, store] : banks) {
          if (live.count(kFirstBank + bank) == 0) continue;
          see(store.address);
          for (const int word : store.words) see(word);
          for (const auto& literal : guard) see(literal.first);
        }
      }
    }
    return live;
  }

  Result<std::string> function(const std::string& name) {
    std::vector<bool> first(static_cast<std::size_t>(step_.graph.size()));
    std::set<std::size_t> cells;
    for (const auto& [output, words] : step_.outputs)
      for (const int word : words) visit(step_.graph, word, first, cells);
    for (const Group& group : groups_) visit(step_.graph, group.mask, first, cells);
    // A cell is read where it stands.
    for (int i = 0; i < step_.graph.size(); ++i) {
      const LaneOp op = step_.graph[i].op;
      if (op == LaneOp::cell || op == LaneOp::mask_cell) first[static_cast<std::size_t>(i)] = false;
    }
    for (Group& group : groups_) {
      auto seen = first;
      visit(step_.graph, group.mask, seen, group.reads);
      for (const Update& update : group.updates) {
        visit(step_.graph, update.value, seen, group.reads);
        if (rings_.count(update.cell) == 0) group.writes.insert(update.cell);
      }
      for (const auto& [bank, store] : group.banks) {
        visit(step_.graph, store.address, seen, group.reads);
        for (const int word : store.words) visit(step_.graph, word, seen, group.reads);
        group.writes.insert(kFirstBank + bank);
      }
    }
    order();
    if (!saved_.empty() && *saved_.rbegin() >= kFirstBank)
      return tool_failed("the lanes do not know memories that take from one another at one edge");

    std::string text = "LANE_STEP void " + name + "(State& s, const Inputs& in, Outputs& out) {\n";
    if (!rings_.empty()) {
      text += fmt::format("  Late& next = s.late[(s.clock + 1) % {}];\n", kRingPlaces);
      for (unsigned age = 0; age <= kOldest; ++age)
        text += fmt::format("  const Late& late{0} = s.late[(s.clock - {0}) % {1}];\n", age, kRingPlaces);
    }
    for (const std::size_t cell : saved_)
      text += fmt::format("  const {0} o{1} = s.c{1};\n", type_of(cell), cell);
    in_group_ = false;
    nodes(text, first, std::vector<bool>(first.size()));
    for (const auto& [output, words] : step_.outputs) {
      for (std::size_t i = 0; i < words.size(); ++i) {
        text += fmt::format("  out.{}{} = {};\n", output, words.size() == 1 ? "" : fmt::format("[{}]", i),
                            reference(words[i]));
      }
    }
    in_group_ = true;
    for (const Group& group : groups_) {
      auto seen = first;
      std::set<std::size_t> reads;
      for (const Update& update : group.updates) {
        const auto [where, value] = changed(update.cell, update.value);
        for (const int node : {where, value})
          if (node >= 0) visit(step_.graph, node, seen, reads);
      }
      for (const auto& [bank, store] : group.banks) {
        visit(step_.graph, store.address, seen, reads);
        for (const int word : store.words) visit(step_.graph, word, seen, reads);
      }
      const bool always = step_.graph[group.mask].op == LaneOp::mask_constant;
      text += always ? "  {\n" : fmt::format("  if ({}) {{\n", reference(group.mask));
      nodes(text, seen, first);
      for (const auto& [cell, value] : group.updates)
        text += fmt::format("  const {} n{} = {};\n", type_of(cell), cell,
                            reference(changed(cell, value).second));
      for (const auto& [cell, value] : group.updates) {
        const int where = changed(cell, value).first;
        std::string mask = always ? "" : reference(group.mask);
        if (where >= 0) mask += (always ? "" : " & ") + reference(where);
        text += mask.empty()
                    ? fmt::format("  {1}.c{0} = n{0};\n", cell, rings_.count(cell) != 0 ? "next" : "s")
                    : fmt::format("  assign({1}, s.c{0}, n{0});\n", cell, mask);
      }
      for (const auto& [bank, store] : group.banks) {
        text += fmt::format("  store(s.bank{}, {}, {}, {{", bank, reference(group.mask),
                            reference(store.address));
        for (const int word : store.words) text += reference(word) + ", ";
        text += "});\n";
      }
      text += "  }\n";
    }
    return text + (rings_.empty() ? "}\n" : "  ++s.clock;\n}\n");
  }

 private:
  int mask_of(const Guard& guard) {
    int all = step_.graph.mask_constant(true);
    for (const auto& [mask, wanted] : guard) {
      if (has_parts(step_.graph[mask], wanted)) continue;
      all = step_.graph.mask_operate(LaneOp::mask_both, all, wanted ? mask : step_.graph.mask_invert(mask));
    }
    return all;
  }

  /// The cell that a group's condition is, read where the group stands.
  std::optional<std::size_t> mask_cell_of(const Group& group) const {
    const LaneNode& mask = step_.graph[group.mask];
    return mask.op == LaneOp::mask_cell ? std::optional<std::size_t>(mask.value) : std::nullopt;
  }

  /// A mask that the group writes may say where its numbers change, and the group's own where all do: until
  /// they have, it keeps its old value.
  void put_masks_last(Group& group) const {
    std::ranges::stable_sort(group.updates, {}, [&](const Update& update) {
      return std::pair(step_.cells[update.cell].mask, mask_cell_of(group) == update.cell);
    });
  }

  bool is_late(std::size_t cell) const {
    const auto ring = rings_.find(cell);
    return ring != rings_.end() && ring->second.age > 0;
  }

  static void visit(const LaneGraph& graph, int node, std::vector<bool>& seen, std::set<std::size_t>& cells) {
    if (static_cast<std::size_t>(node) >= seen.size()) seen.resize(static_cast<std::size_t>(graph.size()));
    if (seen[static_cast<std::size_t>(node)]) return;
    seen[static_cast<std::size_t>(node)] = true;
    const LaneNode& at = graph[node];
    if (at.op == LaneOp::cell || at.op == LaneOp::mask_cell) cells.insert(at.value);
    if (at.op == LaneOp::row) cells.insert(kFirstBank + at.value);
    for (const int operand : at.operands)
      if (operand >= 0) visit(graph, operand, seen, cells);
  }

  /// Where and to what a cell changes, of a value that else is the cell's own; -1: everywhere.
  std::pair<int, int> changed(std::size_t cell, int value) const {
    const LaneNode& node = step_.graph[value];
    if (node.op != LaneOp::select || rings_.count(cell) != 0) return {-1, value};
    const LaneNode& other = step_.graph[node.operands[2]];
    if (other.op != LaneOp::cell || other.value != cell) return {-1, value};
    return {node.operands[0], node.operands[1]};
  }

  /// Who reads a register's old value comes before who writes it; where there is no such order, the old value
  /// is kept. Conditions that exclude each other do not meet in a lane, but each is read in all lanes.
  void order() {
    std::vector<Group> ordered, left = std::move(groups_);
    while (!left.empty()) {
      std::size_t best = 0;
      std::set<std::size_t> best_broken;
      for (std::size_t i = 0; i < left.size(); ++i) {
        std::set<std::size_t> broken;
        for (std::size_t k = 0; k < left.size(); ++k) {
          if (k == i) continue;
          if (excludes(left[i].guard, left[k].guard)) {
            if (const auto cell = mask_cell_of(left[k]); cell && left[i].writes.count(*cell) != 0)
              broken.insert(*cell);
            continue;
          }
          std::set_intersection(left[i].writes.begin(), left[i].writes.end(), left[k].reads.begin(),
                                left[k].reads.end(), std::inserter(broken, broken.end()));
        }
        // A bank is too large to be kept: what stores writes nothing else, and can wait.
        const auto banks = [](const std::set<std::size_t>& cells) {
          return std::distance(cells.lower_bound(kFirstBank), cells.end());
        };
        if (i == 0 ||
            std::pair(banks(broken), broken.size()) < std::pair(banks(best_broken), best_broken.size())) {
          best = i;
          best_broken = std::move(broken);
        }
      }
      saved_.insert(best_broken.begin(), best_broken.end());
      ordered.push_back(std::move(left[best]));
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
    }
    groups_ = std::move(ordered);
  }

  const char* type_of(std::size_t cell) const { return step_.cells[cell].mask ? "M" : "V"; }

  std::string reference(int number) const {
    const LaneNode& node = step_.graph[number];
    switch (node.op) {
      case LaneOp::constant:
        return fmt::format("splat({:#x}u)", node.value);
      case LaneOp::mask_constant:
        return node.value != 0 ? "kAll" : "M{0}";
      case LaneOp::cell:
      case LaneOp::mask_cell: {
        const Cell& cell = step_.cells[node.value];
        const bool first = cell.low == 0, last = node.value + 1 == step_.cells.size() ||
                                                 step_.cells[node.value + 1].variable != cell.variable;
        if (cell.input && cell.width == 1 && first && last) return "in." + cell.variable;
        if (const auto ring = rings_.find(node.value); ring != rings_.end())
          return fmt::format("late{}.c{}", ring->second.age, ring->second.head);
        return fmt::format("{}{}",
                           cell.input                                   ? "in.c"
                           : in_group_ && saved_.count(node.value) != 0 ? "o"
                                                                        : "s.c",
                           node.value);
      }
      default:
        return fmt::format("{}{}", node.is_mask() ? 'm' : 'v', number);
    }
  }

  /// Those of `wanted` that are not in `known`, each as a constant of its own.
  void nodes(std::string& text, const std::vector<bool>& wanted, const std::vector<bool>& known) const {
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (!wanted[i] || known[i]) continue;
      const int number = static_cast<int>(i);
      const LaneNode& node = step_.graph[number];
      const std::string expression = expression_of(node);
      if (expression.empty()) continue;
      const char* type = node.is_mask() ? "M" : node.op == LaneOp::row ? "Row" : "V";
      text += fmt::format("  const {} {} = {};\n", type, reference(number), expression);
    }
  }

  std::string expression_of(const LaneNode& node) const {
    std::array<std::string, 3> x;
    for (std::size_t i = 0; i < 3 && node.operands[i] >= 0; ++i) x[i] = reference(node.operands[i]);
    const auto infix = [&](const char* op) { return fmt::format("{} {} {}", x[0], op, x[1]); };
    const auto call = [&](const char* f) { return fmt::format("{}({}, {})", f, x[0], x[1]); };
    switch (node.op) {
      case LaneOp::constant:
      case LaneOp::mask_constant:
      case LaneOp::cell:
      case LaneOp::mask_cell:
        return {};
      case LaneOp::add:
        return infix("+");
      case LaneOp::subtract:
        return infix("-");
      case LaneOp::multiply:
        return infix("*");
      case LaneOp::multiply_high:
        return call("multiply_high");
      case LaneOp::both:
        return infix("&");
      case LaneOp::either:
        return infix("|");
      case LaneOp::differ:
        return infix("^");
      case LaneOp::invert:
        return "~" + x[0];
      case LaneOp::left:
        return fmt::format("{} << {}", x[0], node.value);
      case LaneOp::right:
        return fmt::format("{} >> {}", x[0], node.value);
      case LaneOp::left_by:
        return call("left_by");
      case LaneOp::right_by:
        return call("right_by");
      case LaneOp::signed_right_by:
        return call("signed_right_by");
      case LaneOp::select:
        return fmt::format("select({}, {}, {})", x[0], x[1], x[2]);
      case LaneOp::fill:
        return fmt::format("fill({}, {:#x}u)", x[0], node.value);
      case LaneOp::rom:
        return fmt::format("lookup(c_rom{}, {})", node.value, x[0]);
      case LaneOp::row:
        return fmt::format("load(s.bank{}, {})", node.value, x[0]);
      case LaneOp::word:
        return fmt::format("{}.words[{}]", x[0], node.value);
      case LaneOp::mask_both:
        return infix("&");
      case LaneOp::mask_either:
        return infix("|");
      case LaneOp::mask_differ:
        return infix("^");
      case LaneOp::mask_invert:
        return fmt::format("static_cast<M>(~{})", x[0]);
      case LaneOp::equal:
        return call("equal");
      case LaneOp::less:
        return call("less");
      case LaneOp::signed_less:
        return call("signed_less");
      case LaneOp::bit:
        return fmt::format("test({}, {:#x}u)", x[0], std::uint64_t{1} << node.value);
    }
    return {};
  }

  Step& step_;
  const std::set<std::size_t>& live_;
  const Rings& rings_;
  std::vector<Group> groups_;
  std::set<std::size_t> saved_;
  bool in_group_ = false;
};

// The document

std::optional<std::uint64_t> to_number(std::string_view literal) {
  const std::size_t at = literal.find('h');
  if (at == std::string_view::npos) return std::nullopt;
  return std::strtoull(std::string(literal.substr(at + 1)).c_str(), nullptr, 16);
}

Result<Netlist> read_netlist(const pugi::xml_document& document) {
  Netlist netlist;
  const pugi::xml_node root = document.child("verilator_xml").child("netlist");
  const pugi::xml_node module = root.find_child_by_attribute("module", "topModule", "1");
  const pugi::xml_node scope = module.child("topscope").child("scope");
  if (!scope) return tool_failed("Verilator's XML holds no flattened module");
  for (const pugi::xml_node type : root.child("typetable").children()) {
    const std::string id = type.attribute("id").value();
    const std::string_view kind = type.name();
    if (kind == "basicdtype") {
      netlist.types[id] = static_cast<unsigned>(type.attribute("left").as_int() + 1);
    } else if (kind == "unpackarraydtype") {
      const pugi::xml_node range = type.child("range");
      const auto left = to_number(range.first_child().attribute("name").value());
      const auto right = to_number(range.last_child().attribute("name").value());
      if (!left || !right) return tool_failed("Verilator's XML: an array of unknown size");
      netlist.rooms[id] = {type.attribute("sub_dtype_id").value(), std::max(*left, *right) + 1};
    }
  }
  std::map<std::string, std::string> type_of;
  for (const pugi::xml_node variable : module.children("var")) {
    const std::string name = variable.attribute("name").value();
    type_of[name] = variable.attribute("dtype_id").value();
    if (std::string_view(variable.attribute("dir").value()) == "input")
      netlist.inputs[name] = netlist.types[type_of[name]];
  }
  const std::function<void(pugi::xml_node)> targets = [&](pugi::xml_node node) {
    if (std::string_view(node.name()) == "assigndly") {
      const pugi::xml_node target = node.last_child();
      const bool element = std::string_view(target.name()) == "arraysel";
      const std::string name = (element ? target.first_child() : target).attribute("name").value();
      if (const auto room = netlist.rooms.find(type_of[name]); element && room != netlist.rooms.end()) {
        netlist.memories[name] = {netlist.types[room->second.first], room->second.second};
      } else {
        netlist.registers[name] = netlist.types[type_of[name]];
      }
    }
    for (const pugi::xml_node inner : node.children()) targets(inner);
  };
  for (const pugi::xml_node node : scope.children()) {
    const std::string_view kind = node.name();
    if (kind == "varscope") continue;
    if (kind == "always") {
      const pugi::xml_node edge = node.child("sentree").child("senitem");
      const std::string_view clock = edge.child("varref").attribute("name").value();
      if (std::string_view(edge.attribute("edgeType").value()) != "POS" || clock != "clk" ||
          edge.next_sibling())
        return tool_failed(fmt::format("the lanes do not know an 'always' without the clock's rising edge"));
      for (pugi::xml_node at = node.child("sentree").next_sibling(); at; at = at.next_sibling()) {
        netlist.clocked.push_back(at);
        targets(at);
      }
    } else if (kind == "contassign" || kind == "assignalias") {
      const std::string name = node.last_child().attribute("name").value();
      if (std::string_view(node.last_child().name()) != "varref")
        return tool_failed("the lanes do not know an assignment to a part of a signal");
      if (kind == "contassign" || name != node.first_child().attribute("name").value())
        netlist.drivers[name] = node.first_child();
    } else if (kind == "initial") {
      for (const pugi::xml_node assign : node.children()) {
        const pugi::xml_node datum = assign.first_child(), target = assign.last_child();
        if (std::string_view(target.name()) == "varref") {
          netlist.drivers[target.attribute("name").value()] = datum;
          continue;
        }
        const std::string name = target.first_child().attribute("name").value();
        const auto index = to_number(target.last_child().attribute("name").value());
        const auto value = to_number(datum.attribute("name").value());
        const auto room = netlist.rooms.find(type_of[name]);
        if (std::string_view(target.name()) != "arraysel" || !index || !value || room == netlist.rooms.end())
          return tool_failed(fmt::format("{}: the lanes do not know what it begins with", name));
        Rom& rom = netlist.roms[name];
        rom.bits = netlist.types[room->second.first];
        rom.data.resize(room->second.second);
        if (*index >= rom.data.size() || rom.bits > kWord)
          return tool_failed(fmt::format("{}: a table too wide or too small", name));
        rom.data[*index] = *value;
      }
    } else {
      return tool_failed(fmt::format("the lanes do not know '{}' in a module", kind));
    }
  }
  // What nothing drives is a register that never changes.
  for (const auto& [name, type] : type_of) {
    const auto width = netlist.types.find(type);
    if (width != netlist.types.end() && netlist.inputs.count(name) == 0 && netlist.drivers.count(name) == 0)
      netlist.registers.emplace(name, width->second);
  }
  netlist.inputs.erase("clk");
  for (const auto& [name, width] : netlist.registers) netlist.roms.erase(name);
  for (const auto& [name, memory] : netlist.memories) {
    if (netlist.roms.erase(name) != 0)
      return tool_failed(fmt::format("{}: the lanes do not know what a memory begins with", name));
  }
  return netlist;
}

/// Memories that are written together lie together, others in banks of their own.
Rooms rooms_of(const std::map<std::string, Memory>& memories, const Step& step, const Step& reset_step) {
  using When = std::pair<Guard, int>;
  std::map<std::tuple<std::size_t, When, When>, std::vector<std::string>> together;
  Rooms rooms;
  std::size_t words = 0;
  const auto add = [&](const std::string& name) {
    rooms[name] = words;
    words += memories.at(name).words();
  };
  const auto end_bank = [&] { words = (words + kRow - 1) / kRow * kRow; };
  for (const auto& [name, memory] : memories) {
    const auto a = step.stores.find(name), b = reset_step.stores.find(name);
    if (a != step.stores.end() && b != reset_step.stores.end()) {
      together[{memory.places, {a->second.guard, a->second.address}, {b->second.guard, b->second.address}}]
          .push_back(name);
    } else {
      add(name);
      end_bank();
    }
  }
  for (const auto& [when, names] : together) {
    for (const std::string& name : names) add(name);
    end_bank();
  }
  return rooms;
}

}  // namespace

Result<std::string> generate_lanes(std::string_view xml, const LanePorts& ports) {
  pugi::xml_document document;
  if (const auto parsed = document.load_buffer(xml.data(), xml.size()); !parsed)
    return tool_failed(fmt::format("Verilator's XML cannot be read: {}", parsed.description()));
  auto netlist = read_netlist(document);
  if (!netlist) return netlist.error();
  netlist->inputs.erase("reset");
  for (const auto& fixed : ports.fixed) netlist->inputs.erase(fixed.first);

  Layout layout;
  layout.rooms = rooms_of(netlist->memories, {}, {});
  while (true) {
    Layout next = layout;
    auto step = Builder(*netlist, ports, false, next).build();
    if (!step) return step.error();
    auto reset_step = Builder(*netlist, ports, true, next).build();
    if (!reset_step) return reset_step.error();
    std::map<std::pair<Writes, Writes>, std::string> first;
    for (const auto& [name, writes] : step->writes) {
      const auto [twin, alone] = first.try_emplace({writes, reset_step->writes[name]}, name);
      if (!alone) next.twins[name] = twin->second;
    }
    next.rooms = rooms_of(netlist->memories, *step, *reset_step);
    if (next != layout || !layout.words) {
      next.words = layout.words || next == layout;
      layout = std::move(next);
      continue;
    }

    const std::set<std::size_t> live = Writer::live_cells(*step, layout.rooms);
    const Rings rings = find_rings(*step, *reset_step, live);
    std::string state, masks, late, inputs, outputs, setters, tables;
    std::map<std::string, std::string> fields;
    for (std::size_t i = 0; i < step->cells.size(); ++i) {
      const Cell& cell = step->cells[i];
      if (!cell.input) {
        if (live.count(i) == 0) continue;
        const auto ring = rings.find(i);
        if (cell.mask) {
          masks += fmt::format("  M c{}{{}};\n", i);
        } else if (ring == rings.end()) {
          state += fmt::format("  V c{}{{}};\n", i);
        } else if (ring->second.age == 0) {
          late += fmt::format("  V c{}{{}};\n", i);
        }
      } else if (netlist->inputs[cell.variable] == 1) {
        inputs += fmt::format("  M {}{{}};\n", cell.variable);
      } else {
        std::string& field = fields[cell.variable];
        if (live.count(i) == 0) continue;
        inputs += fmt::format("  {} c{}{{}};\n", cell.mask ? "M" : "V", i);
        field += fmt::format("  set_lane(in.c{}, lane, field<{}, {}>(words));\n", i, cell.low, cell.width);
      }
    }
    for (const auto& [name, words] : step->outputs) {
      outputs += fmt::format("  {} {}{};\n", step->graph[words[0]].is_mask() ? "M" : "V", name,
                             words.size() == 1 ? "" : fmt::format("[{}]", words.size()));
    }
    for (const auto& [name, field] : fields) {
      setters += fmt::format(
          "LANE_FUNCTION void set_{}(Inputs& in, unsigned lane, const std::uint32_t* words) {{\n{}}}\n", name,
          field);
    }
    std::size_t number = 0;
    std::set<std::vector<std::uint64_t>> written;
    for (const auto& [name, rom] : netlist->roms) {
      if (written.insert(rom.data).second) {
        tables += fmt::format("constexpr std::uint32_t c_rom{}[{}] = {{", number, rom.data.size());
        for (const std::uint64_t datum : rom.data) tables += fmt::format("{}u,", datum);
        tables += "};\n";
      }
      ++number;
    }
    std::map<std::size_t, std::size_t> banks;
    for (const auto& [name, memory] : netlist->memories)
      for (std::size_t i = 0; i < memory.words(); ++i) banks[(layout.rooms[name] + i) / kRow] = memory.places;
    for (const auto& [bank, places] : banks)
      if (live.count(kFirstBank + bank) != 0) masks += fmt::format("  Memory<{}> bank{};\n", places, bank);
    if (!late.empty()) {
      late = "struct Late {\n" + late + "};\n";
      masks += fmt::format("  Late late[{}];\n  unsigned clock = 0;\n", kRingPlaces);
    }
    const auto function = Writer(*step, layout.rooms, live, rings).function("step");
    if (!function) return function.error();
    const auto reset_function = Writer(*reset_step, layout.rooms, live, rings).function("reset_step");
    if (!reset_function) return reset_function.error();
    return late + "struct State {\n" + state + masks + "};\nstruct Inputs {\n" + inputs +
           "};\nstruct Outputs {\n" + outputs + "};\n" + tables + setters + *function + *reset_function;
  }
}

}  // namespace halfway

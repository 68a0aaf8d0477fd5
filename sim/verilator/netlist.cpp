// SPDX-License-Identifier: Apache-2.0
#include "sim/verilator/netlist.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace halfway {
namespace {

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '$';
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

bool take(std::string_view& text, std::string_view beginning) {
  if (text.substr(0, beginning.size()) != beginning) return false;
  text.remove_prefix(beginning.size());
  return true;
}

std::optional<unsigned> take_number(std::string_view& text) {
  unsigned value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

std::string_view take_name(std::string_view& text) {
  std::size_t length = 0;
  while (length < text.size() && is_name_character(text[length])) ++length;
  const std::string_view name = text.substr(0, length);
  text.remove_prefix(length);
  return name;
}

/// `[high:0] ` or nothing: the width.
unsigned take_width(std::string_view& text) {
  text = trim(text);
  if (!take(text, "[")) return 1;
  const unsigned high = take_number(text).value_or(0);
  take(text, ":0]");
  text = trim(text);
  return high + 1;
}

/// The line without comments `/* ... */` and `// ...`; GHDL keeps a comment on one line.
std::string without_comments(std::string_view line) {
  std::string code(line);
  for (std::size_t at; (at = code.find("/*")) != std::string::npos;) {
    const std::size_t end = code.find("*/", at + 2);
    code.erase(at, end == std::string::npos ? std::string::npos : end + 2 - at);
  }
  return code.substr(0, code.find("//"));
}

Error refuse(std::size_t line_number, std::string_view line, std::string_view what) {
  return tool_failed(
      fmt::format("netlist.v:{}: {}; write the RTL without it: {}", line_number, what, trim(line)));
}

/// Of a binary constant; nothing where it is none.
std::optional<std::string> constant_part(std::string_view text, unsigned high, unsigned low) {
  const auto width = take_number(text);
  if (!width || !take(text, "'b") || text.size() != *width || high >= *width) return std::nullopt;
  if (text.find_first_not_of("01x") != std::string_view::npos) return std::nullopt;
  return fmt::format("{}'b{}", high - low + 1, text.substr(*width - 1 - high, high - low + 1));
}

/// The text with `f(name, what follows)` in place of each name; digits behind a constant's base are none.
template <class F>
std::string with_names(std::string_view text, F&& f) {
  std::string result;
  while (!text.empty()) {
    const bool constant = text.front() >= '0' && text.front() <= '9';
    const std::string name(take_name(text));
    if (name.empty()) {
      result += text.front();
      text.remove_prefix(1);
    } else if (constant) {
      result += name;
      if (take(text, "'")) (result += '\'') += take_name(text);
    } else {
      result += f(name, text);
    }
  }
  return result;
}

/// Calls `f` with each name in the text.
template <class F>
void for_each_name(std::string_view text, F&& f) {
  with_names(text, [&](const std::string& name, std::string_view) {
    f(name);
    return name;
  });
}

// A module of the netlist, as far as it is understood: GHDL writes one statement a line.

struct Slice {
  std::string name;
  unsigned high = 0, low = 0;
  unsigned width() const { return high - low + 1; }
  friend bool operator==(const Slice&, const Slice&) = default;
};

class Module {
 public:
  void declare(std::string_view name, unsigned width) { widths_.insert_or_assign(std::string(name), width); }
  void assign(std::string_view name, std::string_view expression) {
    assigns_.insert_or_assign(std::string(name), std::string(expression));
  }
  std::optional<unsigned> width(const std::string& name) const {
    const auto found = widths_.find(name);
    return found == widths_.end() ? std::nullopt : std::optional(found->second);
  }

  /// A name, `name[i]` or `name[h:l]` and nothing else.
  std::optional<Slice> to_slice(std::string_view text) const {
    text = trim(text);
    const std::string name(take_name(text));
    const auto whole = width(name);
    if (!whole) return std::nullopt;
    Slice slice{name, *whole - 1, 0};
    if (text.empty()) return slice;
    if (!take(text, "[")) return std::nullopt;
    const auto high = take_number(text);
    if (!high) return std::nullopt;
    slice.high = slice.low = *high;
    if (take(text, ":")) {
      const auto low = take_number(text);
      if (!low) return std::nullopt;
      slice.low = *low;
    }
    if (text != "]" || slice.high < slice.low || slice.high >= *whole) return std::nullopt;
    return slice;
  }

  /// The parts of `{a, b, c}`, the last first (least significant first), where every part is a slice or a
  /// constant.
  struct Part {
    std::string text;
    unsigned width = 0;
  };
  std::vector<Part> to_parts(std::string_view text) const {
    text = trim(text);
    if (text.size() < 2 || text.front() != '{' || text.back() != '}') return {};
    text = text.substr(1, text.size() - 2);
    if (text.find_first_of("{}") != std::string_view::npos) return {};
    std::vector<Part> parts;
    while (true) {
      const std::size_t comma = text.find(',');
      std::string_view element = trim(text.substr(0, comma));
      Part part{std::string(element), 0};
      if (const auto slice = to_slice(element)) {
        part.width = slice->width();
      } else {
        const auto bits = take_number(element);
        if (!bits || !take(element, "'b")) return {};
        part.width = *bits;
      }
      parts.push_back(std::move(part));
      if (comma == std::string_view::npos) break;
      text.remove_prefix(comma + 1);
    }
    std::reverse(parts.begin(), parts.end());
    return parts;
  }

  const std::map<std::string, std::string, std::less<>>& assigns() const { return assigns_; }
  const std::string* expression_of(const std::string& name) const {
    const auto found = assigns_.find(name);
    return found == assigns_.end() ? nullptr : &found->second;
  }

  /// Follows plain assignments, slices and concatenations to where the bits come from.
  Slice origin(Slice slice) const {
    for (int hops = 0; hops < 1000; ++hops) {
      const std::string* expression = expression_of(slice.name);
      if (expression == nullptr) return slice;
      std::optional<Slice> from = to_slice(*expression);
      if (from && from->width() == width(slice.name)) {
        slice = {from->name, from->low + slice.high, from->low + slice.low};
        continue;
      }
      unsigned low = 0;
      from.reset();
      for (const Part& part : to_parts(*expression)) {
        if (slice.low >= low && slice.high < low + part.width) {
          from = to_slice(part.text);
          break;
        }
        low += part.width;
      }
      if (!from) return slice;
      slice = {from->name, from->low + slice.high - low, from->low + slice.low - low};
    }
    return slice;
  }

  /// Of what `text` names, the bits that `slice` has of as wide a wire.
  std::optional<Slice> part_of(std::string_view text, const Slice& slice) const {
    const auto whole = to_slice(text);
    if (!whole || whole->width() != width(slice.name)) return std::nullopt;
    return Slice{whole->name, whole->low + slice.high, whole->low + slice.low};
  }

  /// The bits of a constant, or of one among parts that are put together.
  std::optional<std::string> constant_at(const Slice& slice) const {
    const std::string* expression = expression_of(slice.name);
    if (expression == nullptr) return std::nullopt;
    unsigned low = 0;
    for (const Part& part : to_parts(*expression)) {
      if (slice.low >= low && slice.high < low + part.width)
        return constant_part(part.text, slice.high - low, slice.low - low);
      low += part.width;
    }
    return constant_part(*expression, slice.high, slice.low);
  }

  std::string to_text(const Slice& slice) const {
    const unsigned whole = *width(slice.name);
    if (slice.low == 0 && slice.high == whole - 1) return slice.name;
    if (slice.high == slice.low) return fmt::format("{}[{}]", slice.name, slice.low);
    return fmt::format("{}[{}:{}]", slice.name, slice.high, slice.low);
  }

  /// A slice by where its bits come from: of a choice it is the choice of slices, of parts those that it
  /// meets.
  std::string straight(const std::string& expression) const;

 private:
  std::map<std::string, unsigned, std::less<>> widths_;
  std::map<std::string, std::string, std::less<>> assigns_;
};

/// A slice or a constant.
bool is_plain(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return is_name_character(c) || c == '[' || c == ']' || c == ':' || c == '\'';
  });
}

/// `a & b`, or with another operation between plain operands.
std::optional<std::pair<std::string, std::string>> to_operands(std::string_view expression,
                                                               std::string_view operation) {
  const std::size_t at = expression.find(operation);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view a = trim(expression.substr(0, at)),
                         b = trim(expression.substr(at + operation.size()));
  if (!is_plain(a) || !is_plain(b)) return std::nullopt;
  return std::pair(std::string(a), std::string(b));
}

/// `condition ? a : b` with plain operands.
struct Choice {
  std::string condition, then_value, else_value;
};
std::optional<Choice> to_choice(std::string_view expression) {
  const std::size_t question = expression.find(" ? "), colon = expression.find(" : ");
  if (question == std::string_view::npos || colon == std::string_view::npos || colon < question)
    return std::nullopt;
  Choice choice{std::string(trim(expression.substr(0, question))),
                std::string(trim(expression.substr(question + 3, colon - question - 3))),
                std::string(trim(expression.substr(colon + 3)))};
  for (const std::string* part : {&choice.condition, &choice.then_value, &choice.else_value})
    if (!is_plain(*part)) return std::nullopt;
  return choice;
}

std::string Module::straight(const std::string& expression) const {
  const auto slice = to_slice(expression);
  if (!slice) return expression;
  const Slice from = origin(*slice);
  const std::string* known = expression_of(from.name);
  if (known == nullptr || from.width() == width(from.name)) return to_text(from);
  if (const auto choice = to_choice(*known)) {
    const auto then_part = part_of(choice->then_value, from), else_part = part_of(choice->else_value, from);
    if (!then_part || !else_part) return to_text(from);
    return fmt::format("{} ? {} : {}", choice->condition, to_text(origin(*then_part)),
                       to_text(origin(*else_part)));
  }
  std::string joined;
  unsigned low = 0;
  for (const Part& part : to_parts(*known)) {
    const unsigned begin = std::max(low, from.low), end = std::min(low + part.width, from.high + 1);
    if (begin < end) {
      const auto inner = to_slice(part.text);
      const auto constant = constant_part(part.text, end - 1 - low, begin - low);
      if (!inner && !constant) return to_text(from);
      const std::string text =
          inner ? to_text(origin({inner->name, inner->low + end - 1 - low, inner->low + begin - low}))
                : *constant;
      joined = joined.empty() ? text : text + ", " + joined;
    }
    low += part.width;
  }
  return joined.empty() ? to_text(from) : '{' + joined + '}';
}

/// What the RTL says for the sake of a synthesizer's cells, said as a simulator likes it. The meaning is the
/// same.
class Simplifier {
 public:
  explicit Simplifier(Module& module) : module_(module) {}

  void apply() {
    const auto before = module_.assigns();
    for (const auto& [name, expression] : before) drop_mask(name, expression);
    for (const auto& [name, expression] : before) join_parts(name, expression);
    for (const auto& [name, expression] : before) part_choice(name, expression);
  }
  /// Wires that were not there before.
  const std::vector<std::string>& fresh() const { return fresh_; }

 private:
  using Bits = std::set<std::pair<std::string, unsigned>>;

  /// `x[high] & (a[i] | b[j] | …)`: the highest bit alone, where that is never set while those are not.
  void drop_mask(const std::string& name, const std::string& expression) {
    const auto both = to_operands(expression, " & ");
    if (!both) return;
    for (const auto& [bit, mask] : {*both, std::pair(both->second, both->first)}) {
      const auto slice = module_.to_slice(bit);
      if (!slice || slice->width() != 1) continue;
      const Slice high = module_.origin(*slice);
      const unsigned width = *module_.width(high.name);
      if (width == 1 || high.low != width - 1 || module_.expression_of(high.name) == nullptr) continue;
      Bits zeros;
      gather(mask, zeros);
      const auto most = most_of(Slice{high.name, width - 1, 0}, zeros);
      if (!most || *most >> (width - 1) != 0) continue;
      module_.assign(name, module_.to_text(high));
      return;
    }
  }

  /// The bits that are all zero where a mask is.
  void gather(const std::string& mask, Bits& bits) const {
    const auto slice = module_.to_slice(mask);
    if (!slice || slice->width() != 1) return;
    const Slice from = module_.origin(*slice);
    bits.emplace(from.name, from.low);
    const std::string* expression = module_.expression_of(from.name);
    if (expression == nullptr || module_.width(from.name) != 1) return;
    if (const auto either = to_operands(*expression, " | ")) {
      gather(either->first, bits);
      gather(either->second, bits);
    }
  }

  /// A number that the slice's never exceeds where bits are zero.
  std::optional<std::uint64_t> most_of(const Slice& slice, const Bits& zeros) const {
    const Slice from = module_.origin(slice);
    if (from.width() >= 64) return std::nullopt;
    std::uint64_t most = 0;
    for (unsigned bit = 0; bit < from.width(); ++bit)
      if (zeros.count({from.name, from.low + bit}) == 0) most |= std::uint64_t{1} << bit;
    const std::string* expression = module_.expression_of(from.name);
    if (expression == nullptr || from.width() != module_.width(from.name)) return most;
    if (const auto counted = most_of(*expression, zeros)) most = std::min(most, *counted);
    return most;
  }
  /// Of a sum or a product, which may be too wide, or of parts.
  std::optional<std::uint64_t> most_of(const std::string& expression, const Bits& zeros) const {
    for (const char* operation : {" + ", " * "}) {
      const auto terms = to_operands(expression, operation);
      if (!terms) continue;
      const auto a = module_.to_slice(terms->first), b = module_.to_slice(terms->second);
      if (!a || !b || a->width() != b->width()) return std::nullopt;
      const auto most_a = most_of(*a, zeros), most_b = most_of(*b, zeros);
      if (!most_a || !most_b) return std::nullopt;
      std::uint64_t most = 0;
      const bool wraps = operation[1] == '+' ? __builtin_add_overflow(*most_a, *most_b, &most)
                                             : __builtin_mul_overflow(*most_a, *most_b, &most);
      return wraps || most >> a->width() != 0 ? std::nullopt : std::optional(most);
    }
    std::uint64_t most = 0;
    unsigned low = 0;
    for (const Module::Part& part : module_.to_parts(expression)) {
      if (low + part.width >= 64) return std::nullopt;
      std::uint64_t part_most = 0;
      if (const auto slice = module_.to_slice(part.text)) {
        const auto found = most_of(*slice, zeros);
        if (!found) return std::nullopt;
        part_most = *found;
      } else if (part.text != fmt::format("{}'b0", part.width)) {
        return std::nullopt;
      }
      most |= part_most << low;
      low += part.width;
    }
    return low == 0 ? std::nullopt : std::optional(most);
  }

  /// `{x[3], x[2:0]}` is `x[3:0]`.
  void join_parts(const std::string& name, const std::string& expression) {
    std::optional<Slice> joined;
    for (const Module::Part& part : module_.to_parts(expression)) {
      const auto slice = module_.to_slice(part.text);
      if (!slice) return;
      const Slice from = module_.origin(*slice);
      if (joined && (from.name != joined->name || from.low != joined->high + 1)) return;
      joined = Slice{from.name, from.high, joined ? joined->low : from.low};
    }
    if (joined) module_.assign(name, module_.to_text(*joined));
  }

  /// `(a | b) ? (a ? x : y) : z` is `b ? (a ? x : y) : (a ? x : z)`, where b is known in what is chosen.
  void part_choice(const std::string& name, const std::string& expression) {
    const auto choice = to_choice(expression);
    const std::string* condition = choice ? module_.expression_of(choice->condition) : nullptr;
    const auto either = condition ? to_operands(*condition, " | ") : std::nullopt;
    const auto inner = either ? choice_of(choice->then_value) : std::nullopt;
    if (!inner) return;
    for (const auto& [a, b] : {*either, std::pair(either->second, either->first)}) {
      if (!same(inner->condition, a)) continue;
      const std::string both = add(name, fmt::format("{} ? {} : {}", a, where({b, true}, inner->then_value),
                                                     where({b, true}, inner->else_value))),
                        one = add(name, fmt::format("{} ? {} : {}", a, where({b, false}, inner->then_value),
                                                    choice->else_value));
      module_.assign(name, fmt::format("{} ? {} : {}", b, both, one));
      return;
    }
  }

  /// Also `x & ~a`, which is `a ? 0 : x`.
  std::optional<Choice> choice_of(const std::string& text) const {
    const auto slice = module_.to_slice(text);
    const std::string* expression = slice ? whole_expression(*slice) : nullptr;
    if (expression == nullptr) return std::nullopt;
    const auto both = slice->width() == 1 ? to_operands(*expression, " & ") : std::nullopt;
    if (!both) return to_choice(*expression);
    for (const auto& [value, mask] : {*both, std::pair(both->second, both->first)}) {
      const auto inverse = module_.to_slice(mask);
      const std::string* inverted = inverse ? whole_expression(module_.origin(*inverse)) : nullptr;
      if (inverted != nullptr && inverted->front() == '~' && is_plain(inverted->substr(1)))
        return Choice{inverted->substr(1), "1'b0", value};
    }
    return std::nullopt;
  }
  const std::string* whole_expression(const Slice& slice) const {
    return slice.width() == module_.width(slice.name) ? module_.expression_of(slice.name) : nullptr;
  }

  bool same(const std::string& a, const std::string& b) const {
    const auto x = module_.to_slice(a), y = module_.to_slice(b);
    return x && y && module_.origin(*x) == module_.origin(*y);
  }

  using Known = std::pair<std::string, bool>;  ///< a condition, and whether it holds

  /// A text where that is known: with wires of their own where it makes a difference.
  std::string where(const Known& known, const std::string& text) {
    return with_names(text, [&](const std::string& name, std::string_view) {
      const std::string* expression = module_.expression_of(name);
      if (expression == nullptr) return name;
      const auto [found, first] = versions_.try_emplace({known, name}, name);
      if (!first) return found->second;
      const std::string was = *expression;
      const auto choice = to_choice(was);
      const bool decided = choice && same(choice->condition, known.first);
      const std::string now = where(known, !decided       ? was
                                           : known.second ? choice->then_value
                                                          : choice->else_value);
      return now == was ? name : versions_[{known, name}] = add(name, now);
    });
  }

  /// A wire like another one.
  std::string add(const std::string& like, const std::string& expression) {
    fresh_.push_back(fmt::format("{}__part{}", like, fresh_.size()));
    module_.declare(fresh_.back(), *module_.width(like));
    module_.assign(fresh_.back(), expression);
    return fresh_.back();
  }

  Module& module_;
  std::map<std::pair<Known, std::string>, std::string> versions_;
  std::vector<std::string> fresh_;
};

/// What a register does at the clock edge: nothing, `q <= value`, or one or the other by a condition.
struct Update {
  enum class Kind { hold, load, choose } kind = Kind::load;
  std::string text;              ///< load: the value; choose: the condition
  std::vector<Update> branches;  ///< choose: then, else
  bool can_hold() const {
    if (kind != Kind::choose) return kind == Kind::hold;
    return branches[0].can_hold() || branches[1].can_hold();
  }
};

constexpr int kMostChoices = 6;  ///< deep: a value deeper than this is loaded as it is

Update update_of(const Module& module, const Slice& value, const Slice& target, Wires wires, int depth = 0) {
  const Slice from = module.origin(value);
  if (from == target) return {Update::Kind::hold, {}, {}};
  Update load{Update::Kind::load, module.to_text(from), {}};
  const std::string* expression = module.expression_of(from.name);
  if (expression == nullptr) return load;
  if (auto constant = module.constant_at(from)) return {Update::Kind::load, std::move(*constant), {}};
  // In place of the wire stands what it is assigned, in the same width: worked out only where it is loaded.
  const bool whole = from.width() == module.width(from.name);
  if (!whole) {
    if (wires == Wires::outside) return load;
    load.text = module.straight(load.text);
  } else if (wires == Wires::outside || depth == 0) {
    load.text = *expression;
  }
  const auto choice = to_choice(*expression);
  if (depth == kMostChoices || !choice) return load;
  Update update{Update::Kind::choose, choice->condition, {}};
  for (const std::string* branch : {&choice->then_value, &choice->else_value}) {
    if (const auto part = module.part_of(*branch, from)) {
      update.branches.push_back(update_of(module, *part, target, wires, depth + 1));
    } else if (auto constant = constant_part(*branch, from.high, from.low)) {
      update.branches.push_back({Update::Kind::load, std::move(*constant), {}});
    } else {
      return load;
    }
  }
  return wires == Wires::inside || update.can_hold() ? update : load;
}

// What the registers do, as text: choices by their conditions, what is loaded under each, and before it the
// wires that nothing else asks for, and inputs that are asked for in several places here and nowhere else:
// what an input is given is formed where it is read, if that is one place.

struct Block {
  struct Choice {
    std::string condition;
    std::vector<Block> branches;  ///< then, else
  };
  std::vector<std::string> inputs;  ///< each copied to what copy_of names
  std::vector<std::string> wires;
  std::vector<Choice> choices;
  std::vector<std::pair<std::string, std::string>> loads;  ///< register, value
};

void add(Block& block, const Update& update, const std::string& target) {
  if (update.kind == Update::Kind::load) block.loads.emplace_back(target, update.text);
  if (update.kind != Update::Kind::choose) return;
  auto choice = std::find_if(block.choices.begin(), block.choices.end(),
                             [&](const Block::Choice& known) { return known.condition == update.text; });
  if (choice == block.choices.end()) choice = block.choices.insert(choice, {update.text, {{}, {}}});
  for (std::size_t i = 0; i < 2; ++i) add(choice->branches[i], update.branches[i], target);
}

std::string copy_of(const std::string& input) {
  return input + "__here";
}

std::string to_text(const Module& module, const Block& block, std::set<std::string> copied = {}) {
  std::string text;
  const auto with_copies = [&](std::string_view expression) {
    return with_names(expression, [&](const std::string& name, std::string_view) {
      return copied.count(name) != 0 ? copy_of(name) : name;
    });
  };
  for (const std::string& input : block.inputs) {
    text += fmt::format("{} = {}; ", copy_of(input), input);
    copied.insert(input);
  }
  for (const std::string& wire : block.wires)
    text += fmt::format("{} = {}; ", wire, with_copies(*module.expression_of(wire)));
  for (const auto& [name, branches] : block.choices) {
    const std::string condition = with_copies(name), then_text = to_text(module, branches[0], copied),
                      else_text = to_text(module, branches[1], copied);
    if (then_text.empty()) {
      if (!else_text.empty()) text += fmt::format("if (!{}) begin {}end ", condition, else_text);
      continue;
    }
    text += fmt::format("if ({}) begin {}end ", condition, then_text);
    if (!else_text.empty()) text += fmt::format("else begin {}end ", else_text);
  }
  for (const auto& [target, value] : block.loads)
    text += fmt::format("{} <= {}; ", target, with_copies(value));
  return text;
}

/// All wires of a block and its branches, and copies of inputs.
void gather_wires(const Block& block, std::vector<std::string>& wires) {
  for (const std::string& input : block.inputs) wires.push_back(copy_of(input));
  wires.insert(wires.end(), block.wires.begin(), block.wires.end());
  for (const Block::Choice& choice : block.choices)
    for (const Block& branch : choice.branches) gather_wires(branch, wires);
}

/// Expressions without the names of slices, constants and concatenations: such stand wherever a name does,
/// but for one that is sliced.
class Inliner {
 public:
  explicit Inliner(const Module& module) : module_(module) {}

  std::string inlined(std::string_view text) const {
    return with_names(text, [&](const std::string& name, std::string_view rest) {
      const std::string* known = rest.substr(0, 1) == "[" ? nullptr : module_.expression_of(name);
      return known != nullptr && stands_alone(*known) ? inlined(*known) : name;
    });
  }
  void apply(Update& update) const {
    update.text = inlined(update.text);
    for (Update& branch : update.branches) apply(branch);
  }

 private:
  bool stands_alone(const std::string& expression) const {
    return module_.to_slice(expression) || constant_part(expression, 0, 0) ||
           !module_.to_parts(expression).empty();
  }

  const Module& module_;
};

/// Puts wires into the blocks that alone ask for them, and copies of inputs.
class WirePlacer {
 public:
  WirePlacer(const Module& module, const std::vector<std::string>& inputs)
      : module_(module), inputs_(inputs.begin(), inputs.end()) {}

  /// Where a wire is asked for: the branches that lead there; empty: outside, by an instance, a memory, a
  /// port.
  using Place = std::vector<Block*>;

  void ask(std::string_view text, const Place& place = {}) {
    for_each_name(text, [&](const std::string& name) {
      if (module_.expression_of(name) == nullptr && inputs_.count(name) == 0) return;
      ++asked_[name];
      const auto [at, fresh] = places_.try_emplace(name, place);
      if (fresh) return;
      Place& known = at->second;
      const auto differs = std::mismatch(known.begin(), known.end(), place.begin(), place.end());
      known.erase(differs.first, known.end());
    });
  }
  void ask(Block& block, const Place& place = {}) {
    for (const auto& [target, value] : block.loads) ask(value, place);
    for (Block::Choice& choice : block.choices) {
      ask(choice.condition, place);
      for (Block& branch : choice.branches) {
        Place inner = place;
        inner.push_back(&branch);
        ask(branch, inner);
      }
    }
  }

  /// When all is asked for.
  void place() {
    for (const auto& [name, expression] : module_.assigns()) order(name);
    // Who asks comes before what it asks for.
    for (auto wire = order_.rbegin(); wire != order_.rend(); ++wire) {
      if (const auto at = places_.find(*wire); at != places_.end())
        ask(*module_.expression_of(*wire), Place(at->second));
    }
    for (const std::string& wire : order_) {
      if (const auto at = places_.find(wire); at != places_.end() && !at->second.empty())
        at->second.back()->wires.push_back(wire);
    }
    for (const std::string& input : inputs_) {
      if (const auto at = places_.find(input);
          at != places_.end() && !at->second.empty() && asked_.at(input) > 1)
        at->second.back()->inputs.push_back(input);
    }
  }

  bool is_outside(const std::string& wire) const {
    const auto at = places_.find(wire);
    return at != places_.end() && at->second.empty();
  }

 private:
  void order(const std::string& wire) {
    if (!ordered_.insert(wire).second) return;
    for_each_name(*module_.expression_of(wire), [&](const std::string& name) {
      if (module_.expression_of(name) != nullptr) order(name);
    });
    order_.push_back(wire);
  }

  const Module& module_;
  std::set<std::string> inputs_;
  std::map<std::string, Place> places_;
  std::map<std::string, int> asked_;  ///< how often
  std::set<std::string> ordered_;
  std::vector<std::string> order_;  ///< what is asked for before who asks
};

/// `Q <= N;`, the whole of it.
std::optional<std::pair<std::string, std::string>> to_register(std::string_view line) {
  line = trim(line);
  const std::string target(take_name(line));
  if (target.empty() || !take(line, " <= ")) return std::nullopt;
  const std::string value(take_name(line));
  if (value.empty() || line != ";") return std::nullopt;
  return std::pair(target, value);
}

/// A register, or a field of one: its part of the whole, and what it does.
struct Field {
  std::string name;
  Slice value;
  Update update;
  std::string last_condition, last_value;  ///< what comes behind all else
};

/// A choice in front of the others that says what is fixed, as reset does, comes behind them as the last word
/// where other fields have none in front: so that all share the others.
void put_last(std::vector<Field>& fields) {
  std::set<std::string> first;
  for (const Field& field : fields)
    if (field.update.kind == Update::Kind::choose) first.insert(field.update.text);
  for (Field& field : fields) {
    if (field.update.kind != Update::Kind::choose) continue;
    const Update &fixed = field.update.branches[0], &others = field.update.branches[1];
    if (others.kind != Update::Kind::choose || first.count(others.text) == 0 ||
        fixed.kind != Update::Kind::load || !constant_part(fixed.text, 0, 0))
      continue;
    field.last_condition = field.update.text;
    field.last_value = fixed.text;
    field.update = Update(others);
  }
}

/// Where a register of this value, from bit `low` up, is cut: between parts that are put together; with wires
/// inside, in any branch. Lanes and other tools pay for each field's choice.
void find_cuts(const Module& module, const Slice& value, unsigned low, Wires wires, std::set<unsigned>& cuts,
               std::set<std::tuple<std::string, unsigned, unsigned, unsigned>>& seen) {
  const Slice from = module.origin(value);
  const std::string* expression = module.expression_of(from.name);
  if (expression == nullptr || !seen.emplace(from.name, from.high, from.low, low).second) return;
  if (const auto choice = to_choice(*expression); choice && wires == Wires::inside) {
    for (const std::string* branch : {&choice->then_value, &choice->else_value})
      if (const auto part = module.part_of(*branch, from)) find_cuts(module, *part, low, wires, cuts, seen);
  }
  unsigned at = 0;
  for (const Module::Part& part : module.to_parts(*expression)) {
    const unsigned begin = std::max(at, from.low), end = std::min(at + part.width, from.high + 1);
    if (begin < end) {
      const unsigned to = low + begin - from.low;
      if (begin > from.low) cuts.insert(to);
      if (const auto slice = module.to_slice(part.text); slice && wires == Wires::inside)
        find_cuts(module, {slice->name, slice->low + end - 1 - at, slice->low + begin - at}, to, wires, cuts,
                  seen);
    }
    at += part.width;
  }
}

constexpr unsigned kWidestCopy = 64;  ///< bits of an input: wider ones are slow to copy

constexpr std::string_view kClocked = "always @(posedge clk)";

std::string declaration(const Module& module, const std::string& kind, const std::string& name) {
  const unsigned width = *module.width(name);
  return width == 1 ? fmt::format("{} {};", kind, name) : fmt::format("{} [{}:0] {};", kind, width - 1, name);
}

/// The fields, a process each; none for what only holds.
std::string to_processes(const Module& module, const std::vector<Field>& fields) {
  std::string text;
  for (const Field& field : fields) {
    Block block;
    add(block, field.update, field.name);
    const std::string statement = to_text(module, block);
    if (!statement.empty()) text += fmt::format("  {}\n    {}\n", kClocked, trim(statement));
  }
  return text;
}

/// A process for all fields that begin with the same choice, which share what is formed under it.
std::string to_processes(const Module& module, const std::vector<Field>& fields, const Block& root) {
  std::string text;
  for (const auto& [target, value] : root.loads)
    text += fmt::format("  {}\n    {} <= {};\n", kClocked, target, value);
  for (std::size_t i = 0; i < root.choices.size(); ++i) {
    const Block block{{}, {}, {root.choices[i]}, {}};
    text += fmt::format("  {}\n    begin : at_edge_{}\n", kClocked, i);
    std::vector<std::string> wires;
    gather_wires(block, wires);
    for (const std::string& wire : wires) text += fmt::format("      {}\n", declaration(module, "reg", wire));
    // Where each is set first, Verilator makes it local.
    for (const std::string& wire : wires) text += fmt::format("      {} = 0;\n", wire);
    text += fmt::format("      {}\n", trim(to_text(module, block)));
    for (const Field& field : fields) {
      if (!field.last_condition.empty() && field.update.text == root.choices[i].condition)
        text += fmt::format("      if ({}) {} <= {};\n", field.last_condition, field.name, field.last_value);
    }
    text += "    end\n";
  }
  return text;
}

std::string split_module(const std::vector<std::string_view>& lines, Wires wires) {
  Module module;
  std::vector<std::string> code;
  code.reserve(lines.size());
  std::map<std::string, int> writes;  // of each register, over all statements
  std::vector<std::string> inputs, outputs;
  for (const std::string_view line : lines) {
    code.push_back(without_comments(line));
    std::string_view text = trim(code.back());
    if (take(text, "(")) text = trim(text);
    const bool input = text.substr(0, 6) == "input ", output = text.substr(0, 7) == "output ";
    if (take(text, "input ") || take(text, "output ") || take(text, "wire ") || take(text, "reg ")) {
      const unsigned width = take_width(text);
      const std::string_view name = take_name(text);
      // What follows a plain declaration is its end; a memory goes on with its depth and stays unknown.
      if (text == ";" || text == "," || text == ");") module.declare(name, width);
      if (output) outputs.emplace_back(name);
      if (input && width <= kWidestCopy) inputs.emplace_back(name);
    } else if (take(text, "assign ")) {
      const std::string_view name = take_name(text);
      if (take(text, " = ") && !text.empty() && text.back() == ';') {
        module.assign(name, trim(text.substr(0, text.size() - 1)));
      }
    } else if (const std::size_t arrow = text.find(" <= "); arrow != std::string_view::npos) {
      std::string_view target = text;
      ++writes[std::string(take_name(target))];
    }
  }

  Simplifier simplifier(module);
  simplifier.apply();

  // Registers whose next value is put together from parts become one register a part.
  std::vector<Field> fields;
  std::map<std::string, std::vector<std::string>> splits;
  std::set<std::size_t> told;  // lines of the fields' registers
  for (std::size_t i = 0; i + 1 < code.size(); ++i) {
    if (trim(code[i]) != kClocked) continue;
    const auto found = to_register(code[i + 1]);
    if (!found || !module.width(found->first) || writes[found->first] != 1) continue;
    const auto& [target, value] = *found;
    const auto slice = module.to_slice(value);
    if (!slice || module.expression_of(target) != nullptr || slice->width() != *module.width(target))
      continue;
    told.insert({i, i + 1});
    std::set<unsigned> cuts;
    std::set<std::tuple<std::string, unsigned, unsigned, unsigned>> seen;
    find_cuts(module, *slice, 0, wires, cuts, seen);
    cuts.insert(*module.width(target));
    if (cuts.size() == 1) {
      fields.push_back({target, *slice, {}, {}, {}});
      continue;
    }
    auto& names = splits[target];
    unsigned low = 0;
    for (const unsigned end : cuts) {
      names.push_back(fmt::format("{}__{}", target, names.size()));
      fields.push_back({names.back(), {slice->name, slice->low + end - 1, slice->low + low}, {}, {}, {}});
      module.declare(names.back(), end - low);
      low = end;
    }
  }
  for (const auto& [target, names] : splits) {
    std::string joined;
    for (const std::string& name : names) joined = joined.empty() ? name : name + ", " + joined;
    module.assign(target, '{' + joined + '}');
  }

  // Slices go straight to where they come from.
  const auto assigns = module.assigns();
  for (const auto& [name, expression] : assigns) {
    if (const auto slice = module.to_slice(expression))
      module.assign(
          name, wires == Wires::inside ? module.straight(expression) : module.to_text(module.origin(*slice)));
  }
  for (Field& field : fields) {
    const Slice whole{field.name, *module.width(field.name) - 1, 0};
    field.update = update_of(module, field.value, whole, wires);
  }
  if (wires == Wires::inside) {
    // A name for bits that lie elsewhere, or lie together, would be a copy.
    const Inliner inliner(module);
    for (Field& field : fields) inliner.apply(field.update);
    std::map<std::string, std::string> expressions;
    for (const auto& [name, expression] : assigns)
      expressions[name] = inliner.inlined(*module.expression_of(name));
    for (const auto& [name, expression] : expressions) module.assign(name, expression);
    put_last(fields);
  }

  Block root;
  WirePlacer placer(module, inputs);
  if (wires == Wires::inside) {
    for (const Field& field : fields) {
      add(root, field.update, field.name);
      placer.ask(field.last_condition);
    }
    placer.ask(root, {});
    for (const std::string& output : outputs) placer.ask(output);
    for (std::size_t i = 0; i < code.size(); ++i) {
      std::string_view text = trim(code[i]);
      if (take(text, "(")) text = trim(text);
      bool declares = false;
      for (const char* kind : {"wire ", "reg ", "input ", "output "})
        declares = declares || text.starts_with(kind);
      if (!declares && text.substr(0, 7) != "assign " && told.count(i) == 0) placer.ask(text);
    }
    placer.place();
    for (const std::string& input : inputs) module.declare(copy_of(input), *module.width(input));
  }
  const auto is_there = [&](const std::string& wire) {
    return wires == Wires::outside || module.expression_of(wire) == nullptr || placer.is_outside(wire);
  };

  std::string out;
  bool declares = false;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (told.count(i) != 0) continue;
    std::string_view text = trim(code[i]);
    if (take(text, "reg ") || take(text, "wire ")) {
      if (!std::exchange(declares, true)) {
        for (const std::string& wire : simplifier.fresh())
          if (is_there(wire)) out += fmt::format("  {}\n", declaration(module, "wire", wire));
      }
      take_width(text);
      const std::string name(take_name(text));
      if (const auto split = splits.find(name); split != splits.end()) {
        for (const std::string& part : split->second) out += "  " + declaration(module, "reg", part) + '\n';
        if (is_there(name))
          out += fmt::format("  {}\n  assign {} = {};\n", declaration(module, "wire", name), name,
                             *module.expression_of(name));
        continue;
      }
      if (!is_there(name)) continue;
    } else if (take(text, "assign ")) {
      const std::string name(take_name(text));
      if (const std::string* expression = module.expression_of(name); expression != nullptr) {
        if (is_there(name)) out += fmt::format("  assign {} = {};\n", name, *expression);
        continue;
      }
    } else if (text == "endmodule") {
      for (const std::string& wire : simplifier.fresh())
        if (is_there(wire)) out += fmt::format("  assign {} = {};\n", wire, *module.expression_of(wire));
      out += wires == Wires::outside ? to_processes(module, fields) : to_processes(module, fields, root);
    }
    out += lines[i];
    out += '\n';
  }
  return out;
}

}  // namespace

unsigned port_bits(std::string_view netlist, std::string_view top, std::string_view port) {
  bool inside = false;
  for (std::string_view line : lines_of(netlist)) {
    line = trim(line);
    if (take(line, "module ")) {
      inside = trim(line) == top;
    } else if (inside) {
      if (take(line, "(")) line = trim(line);
      if (!take(line, "input ") && !take(line, "output ")) return 0;
      const unsigned width = take_width(line);
      if (take_name(line) == port) return width;
    }
  }
  return 0;
}

Result<std::string> mend_netlist(std::string_view netlist) {
  std::string out;
  out.reserve(netlist.size());
  std::size_t number = 0;
  bool in_always = false;
  for (const std::string_view line : lines_of(netlist)) {
    ++number;
    // GHDL marks these three in a comment; it prints them without $signed.
    for (const std::string_view mark : {"// sdiv", "// smod", "// srem"}) {
      if (line.find(mark) != std::string_view::npos)
        return refuse(number, line, "a signed division, printed as unsigned");
    }
    std::string code = without_comments(line);
    for (std::size_t open; (open = code.find('"')) != std::string::npos;) {
      const std::size_t close = code.find('"', open + 1);
      if (close == std::string::npos) return refuse(number, line, "a quoted string");
      std::string digits = code.substr(open + 1, close - open - 1);
      for (char& digit : digits) {
        if (std::string_view("UXWZ-").find(digit) != std::string_view::npos) digit = 'x';
        if (digit != '0' && digit != '1' && digit != 'x') return refuse(number, line, "a quoted string");
      }
      if (digits.empty()) return refuse(number, line, "a quoted string");
      code.replace(open, close + 1 - open, fmt::format("{}'b{}", digits.size(), digits));
    }
    for (std::size_t at = 0; (at = code.find("'bZ", at)) != std::string::npos; ++at) code[at + 2] = 'x';

    if (const std::size_t at = code.find(" >> "); at != std::string::npos && code.find("$signed(") < at) {
      return refuse(number, line, "shift_right of a signed, printed as a logical shift");
    }
    const std::string_view text = trim(code);
    if (text.substr(0, 6) == "always") in_always = true;
    const bool arrow_outside =
        text.find(" <= ") != std::string_view::npos && !in_always && text.substr(0, 7) != "assign ";
    for (const std::string_view vhdl :
         {"std_logic_vector", " when ", " abs ", "(abs ", "unsigned'", "signed'"}) {
      if (text.find(vhdl) != std::string_view::npos) return refuse(number, line, "VHDL text");
    }
    if (arrow_outside) return refuse(number, line, "VHDL text");
    // An always without begin holds one statement, which may be a case.
    if (in_always && !text.empty() && text.substr(0, 6) != "always" &&
        (text.substr(0, 6) == "assign" || text.substr(0, 4) == "wire" || text.substr(0, 9) == "endmodule")) {
      in_always = false;
    }
    out += code.empty() || trim(code).empty() ? std::string() : code + '\n';
  }
  return out;
}

std::string split_registers(std::string_view netlist, Wires wires) {
  std::string out;
  std::vector<std::string_view> module;
  for (const std::string_view line : lines_of(netlist)) {
    module.push_back(line);
    if (trim(line) == "endmodule") {
      out += split_module(module, wires);
      module.clear();
    }
  }
  for (const std::string_view line : module) {
    out += line;
    out += '\n';
  }
  return out;
}

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
#include "sim/verilator/netlist.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
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

  std::string to_text(const Slice& slice) const {
    const unsigned whole = *width(slice.name);
    if (slice.low == 0 && slice.high == whole - 1) return slice.name;
    if (slice.high == slice.low) return fmt::format("{}[{}]", slice.name, slice.low);
    return fmt::format("{}[{}:{}]", slice.name, slice.high, slice.low);
  }

 private:
  std::map<std::string, unsigned, std::less<>> widths_;
  std::map<std::string, std::string, std::less<>> assigns_;
};

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
  for (const std::string* part : {&choice.condition, &choice.then_value, &choice.else_value}) {
    for (const char c : *part) {
      if (!is_name_character(c) && c != '[' && c != ']' && c != ':' && c != '\'') return std::nullopt;
    }
  }
  return choice;
}

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

Update update_of(const Module& module, const std::string& value, const Slice& target, int depth = 0) {
  const auto slice = module.to_slice(value);
  if (!slice) return {Update::Kind::load, value, {}};
  const Slice from = module.origin(*slice);
  if (from == target) return {Update::Kind::hold, {}, {}};
  Update load{Update::Kind::load, module.to_text(from), {}};
  const std::string* expression = module.expression_of(from.name);
  if (expression == nullptr || from.low != 0 || from.width() != module.width(from.name)) return load;
  // In place of the wire stands what it is assigned, in the same width: worked out only where it is loaded.
  load.text = *expression;
  if (depth == kMostChoices) return load;
  const auto choice = to_choice(*expression);
  if (!choice) return load;
  Update update{Update::Kind::choose, choice->condition, {}};
  update.branches.push_back(update_of(module, choice->then_value, target, depth + 1));
  update.branches.push_back(update_of(module, choice->else_value, target, depth + 1));
  return update.can_hold() ? update : load;
}

std::string to_statement(const Update& update, const std::string& target) {
  switch (update.kind) {
    case Update::Kind::hold:
      return ";";
    case Update::Kind::load:
      return fmt::format("{} <= {};", target, update.text);
    case Update::Kind::choose:
      break;
  }
  const Update &then_update = update.branches[0], &else_update = update.branches[1];
  if (then_update.kind == Update::Kind::hold) {
    return fmt::format("if (!{}) begin {} end", update.text, to_statement(else_update, target));
  }
  std::string text = fmt::format("if ({}) begin {} end", update.text, to_statement(then_update, target));
  if (else_update.kind != Update::Kind::hold) {
    text += fmt::format(" else begin {} end", to_statement(else_update, target));
  }
  return text;
}

/// `Q <= N;`, the whole of it.
std::optional<std::pair<std::string, std::string>> to_register(std::string_view line) {
  line = trim(line);
  const std::string target(take_name(line));
  if (target.empty() || !take(line, " <= ")) return std::nullopt;
  const std::string value(take_name(line));
  if (value.empty() || line != ";") return std::nullopt;
  return std::pair(target, value);
}

std::string split_module(const std::vector<std::string_view>& lines) {
  constexpr std::string_view clocked = "always @(posedge clk)";
  Module module;
  std::vector<std::string> code;
  code.reserve(lines.size());
  std::map<std::string, int> writes;  // of each register, over all statements
  for (const std::string_view line : lines) {
    code.push_back(without_comments(line));
    std::string_view text = trim(code.back());
    if (take(text, "(")) text = trim(text);
    if (take(text, "input ") || take(text, "output ") || take(text, "wire ") || take(text, "reg ")) {
      const unsigned width = take_width(text);
      const std::string_view name = take_name(text);
      // What follows a plain declaration is its end; a memory goes on with its depth and stays unknown.
      if (text == ";" || text == "," || text == ");") module.declare(name, width);
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

  // Registers whose next value is put together from parts become one register a part.
  std::map<std::string, std::vector<Module::Part>> splits;
  for (std::size_t i = 0; i + 1 < code.size(); ++i) {
    if (trim(code[i]) != clocked) continue;
    const auto found = to_register(code[i + 1]);
    if (!found || writes[found->first] != 1) continue;
    const auto& [target, value] = *found;
    const auto whole = module.width(target);
    const auto slice = module.to_slice(value);
    if (!whole || !slice || module.expression_of(target) != nullptr) continue;
    const Slice from = module.origin(*slice);
    const std::string* expression = module.expression_of(from.name);
    if (expression == nullptr || from.width() != module.width(from.name) || from.width() != *whole) continue;
    auto parts = module.to_parts(*expression);
    unsigned total = 0;
    for (const Module::Part& part : parts) total += part.width;
    if (parts.size() < 2 || total != *whole) continue;
    std::string joined;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const std::string name = fmt::format("{}__{}", target, k);
      module.declare(name, parts[k].width);
      joined = k == 0 ? name : name + ", " + joined;
    }
    module.assign(target, '{' + joined + '}');
    splits.emplace(target, std::move(parts));
  }

  std::string out;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::string_view text = trim(code[i]);
    if (take(text, "reg ")) {
      std::string_view rest = text;
      const unsigned width = take_width(rest);
      const std::string name(take_name(rest));
      const auto split = splits.find(name);
      if (split != splits.end()) {
        for (std::size_t k = 0; k < split->second.size(); ++k) {
          out += fmt::format("  reg [{}:0] {}__{};\n", split->second[k].width - 1, name, k);
        }
        out += fmt::format("  wire [{}:0] {};\n", width - 1, name);
        out += fmt::format("  assign {} = {};\n", name, *module.expression_of(name));
        continue;
      }
    } else if (take(text, "assign ")) {
      // Slices go straight to the register they come from.
      const std::string name(take_name(text));
      if (take(text, " = ") && !text.empty() && text.back() == ';') {
        if (const auto slice = module.to_slice(text.substr(0, text.size() - 1))) {
          out += fmt::format("  assign {} = {};\n", name, module.to_text(module.origin(*slice)));
          continue;
        }
      }
    } else if (text == clocked && i + 1 < lines.size()) {
      const auto found = to_register(code[i + 1]);
      if (found && module.width(found->first) && writes[found->first] == 1) {
        const auto& [target, value] = *found;
        const auto split = splits.find(target);
        const std::size_t count = split == splits.end() ? 1 : split->second.size();
        for (std::size_t k = 0; k < count; ++k) {
          const std::string name = split == splits.end() ? target : fmt::format("{}__{}", target, k);
          const Slice whole{name, *module.width(name) - 1, 0};
          const Update update =
              update_of(module, split == splits.end() ? value : split->second[k].text, whole);
          out += fmt::format("  {}\n    {}\n", clocked, to_statement(update, name));
        }
        ++i;
        continue;
      }
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

std::string split_registers(std::string_view netlist) {
  std::string out;
  std::vector<std::string_view> module;
  for (const std::string_view line : lines_of(netlist)) {
    module.push_back(line);
    if (trim(line) == "endmodule") {
      out += split_module(module);
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

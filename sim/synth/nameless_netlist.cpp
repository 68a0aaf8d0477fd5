// SPDX-License-Identifier: Apache-2.0
#include "sim/synth/nameless_netlist.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace halfway::synth {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_lower(char c) {
  return c >= 'a' && c <= 'z';
}
bool is_word(char c) {
  return is_digit(c) || is_lower(c) || (c >= 'A' && c <= 'Z') || c == '_' || c == '$';
}

// True for the end of a name that GHDL made, after the number: nothing, or an underscore and lower-case
// letters.
bool is_numbered(std::string_view word) {
  if (word.size() < 2 || word[0] != 'n' || !is_digit(word[1])) return false;
  const auto rest = std::find_if_not(word.begin() + 1, word.end(), is_digit);
  return rest == word.end() ||
         (*rest == '_' && rest + 1 != word.end() && std::all_of(rest + 1, word.end(), is_lower));
}

// End of a comment that starts at `at`; `at` if no comment starts there.
std::size_t comment_end(std::string_view text, std::size_t at) {
  const std::string_view rest = text.substr(at);
  std::size_t end = at;
  if (rest.starts_with("//")) {
    end = text.find('\n', at);
  } else if (rest.starts_with("/*")) {
    end = text.find("*/", at + 2);
    if (end != std::string_view::npos) end += 2;
  }
  return std::min(end, text.size());
}

// End a line: remove trailing spaces, and the line itself if it is empty.
void end_line(std::string& text) {
  while (!text.empty() && text.back() == ' ') text.pop_back();
  if (!text.empty() && text.back() != '\n') text += '\n';
}

using Numbers = std::unordered_map<std::string_view, std::size_t>;

constexpr std::string_view c_module = "module ";

// Positions at which the modules of the netlist start.
std::vector<std::size_t> module_starts(std::string_view netlist) {
  std::vector<std::size_t> starts;
  for (std::size_t at = 0; at < netlist.size(); at = std::min(netlist.find('\n', at), netlist.size() - 1) + 1)
    if (netlist.substr(at).starts_with(c_module)) starts.push_back(at);
  return starts;
}

// The modules of the netlist, numbered in their order.
Numbers number_modules(std::string_view netlist, const std::vector<std::size_t>& starts) {
  Numbers modules;
  for (const std::size_t start : starts) {
    const auto begin = netlist.begin() + start + c_module.size();
    const auto end = std::find_if_not(begin, netlist.end(), is_word);
    modules.try_emplace(std::string_view(begin, end), modules.size());
  }
  return modules;
}

// The words of a text without its comments.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}
  /// The next word; empty at the end.
  std::string_view next() {
    while (at_ < text_.size() && !is_word(text_[at_])) {
      const std::size_t end = comment_end(text_, at_);
      at_ = end > at_ ? end : at_ + 1;
    }
    const auto begin = text_.begin() + std::min(at_, text_.size());
    const auto end = std::find_if_not(begin, text_.end(), is_word);
    at_ = static_cast<std::size_t>(end - text_.begin());
    return {begin, end};
  }
  /// Skip spaces and a range such as [7:0].
  void skip_range() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    if (at_ < text_.size() && text_[at_] == '[') at_ = std::min(text_.find(']', at_), text_.size());
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

// The names that a module declares: its nets, its instances, and its ports if `with_ports`.
std::unordered_set<std::string_view> declared_names(std::string_view module, const Numbers& modules,
                                                    bool with_ports) {
  std::unordered_set<std::string_view> names, ports;
  Words words(module);
  std::string_view before;
  for (std::string_view word = words.next(); !word.empty(); before = word, word = words.next()) {
    const bool is_port = word == "input" || word == "output";
    if (is_port || word == "wire" || word == "reg") {
      words.skip_range();
      word = words.next();
      (is_port ? ports : names).insert(word);
    } else if (modules.contains(before) && !modules.contains(word)) {
      names.insert(word);
    }
  }
  for (const std::string_view port : ports)
    if (with_ports)
      names.insert(port);
    else
      names.erase(port);
  return names;
}

// Appends the module, or the text before the first one.
void append_nameless(std::string_view module, const Numbers& modules, bool is_top, std::string& text) {
  const auto names = declared_names(module, modules, !is_top);
  Numbers nets;
  std::size_t at = 0;
  while (at < module.size()) {
    // Skip a comment.
    if (const std::size_t end = comment_end(module, at); end > at) {
      at = end;
      continue;
    }
    // Copy what is not a word.
    if (!is_word(module[at])) {
      if (module[at] == '\n')
        end_line(text);
      else
        text += module[at];
      ++at;
      continue;
    }
    // Copy a word. No name in VHDL contains `$`, so new names differ from all others.
    const auto end = std::find_if_not(module.begin() + at, module.end(), is_word);
    const std::string_view word(module.begin() + at, end);
    const char before = at > 0 ? module[at - 1] : '\n';
    at += word.size();
    // GHDL connects the ports of an instance in the order of their declaration.
    if (before == '.' && at < module.size() && module[at] == '(') continue;
    if (const auto number = modules.find(word); before != '\'' && number != modules.end())
      text += fmt::format("module${}", number->second);
    else if (before != '\'' && (names.contains(word) || is_numbered(word)))
      text += fmt::format("n${}", nets.try_emplace(word, nets.size()).first->second);
    else
      text += word;
  }
}

}  // namespace

std::string nameless(std::string_view netlist) {
  std::string text;
  text.reserve(netlist.size());
  std::vector<std::size_t> starts = module_starts(netlist);
  const Numbers modules = number_modules(netlist, starts);
  starts.insert(starts.begin(), 0);
  starts.push_back(netlist.size());
  for (std::size_t i = 0; i + 1 < starts.size(); ++i)
    append_nameless(netlist.substr(starts[i], starts[i + 1] - starts[i]), modules, i + 2 == starts.size(),
                    text);
  end_line(text);
  return text;
}

}  // namespace halfway::synth

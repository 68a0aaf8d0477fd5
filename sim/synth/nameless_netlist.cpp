// SPDX-License-Identifier: Apache-2.0
#include "sim/synth/nameless_netlist.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <unordered_map>

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

// The modules of the netlist, numbered in their order.
Numbers number_modules(std::string_view netlist) {
  constexpr std::string_view c_module = "module ";
  Numbers modules;
  for (std::size_t at = 0; at < netlist.size();
       at = std::min(netlist.find('\n', at), netlist.size() - 1) + 1) {
    const std::string_view rest = netlist.substr(at);
    if (!rest.starts_with(c_module)) continue;
    const auto begin = rest.begin() + c_module.size();
    const auto end = std::find_if_not(begin, rest.end(), is_word);
    modules.try_emplace(std::string_view(begin, end), modules.size());
  }
  return modules;
}

}  // namespace

std::string nameless(std::string_view netlist) {
  std::string text;
  text.reserve(netlist.size());
  const Numbers modules = number_modules(netlist);
  Numbers nets;
  std::size_t at = 0;
  while (at < netlist.size()) {
    // Skip a comment.
    if (const std::size_t end = comment_end(netlist, at); end > at) {
      at = end;
      continue;
    }
    // Copy what is not a word.
    if (!is_word(netlist[at])) {
      if (netlist[at] == '\n')
        end_line(text);
      else
        text += netlist[at];
      ++at;
      continue;
    }
    // Copy a word. No name in VHDL contains `$`, so new names differ from all others.
    const auto end = std::find_if_not(netlist.begin() + at, netlist.end(), is_word);
    const std::string_view word(netlist.begin() + at, end);
    if (const auto module = modules.find(word); module != modules.end())
      text += fmt::format("module${}", module->second);
    else if (is_numbered(word))
      text += fmt::format("n${}", nets.try_emplace(word, nets.size()).first->second);
    else
      text += word;
    at += word.size();
  }
  end_line(text);
  return text;
}

}  // namespace halfway::synth

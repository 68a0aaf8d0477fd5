// SPDX-License-Identifier: Apache-2.0
#include "sim/cost/netlist_identity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <sstream>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sim/os/file.hpp"

namespace halfway::synth {
namespace {

constexpr std::string_view c_module_head = "module ";

bool is_name_character(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

// A name that GHDL made: n and a number, then nothing or an underscore and letters.
bool is_counted(std::string_view word) {
  const std::size_t end = std::min(word.find_first_not_of("0123456789", 1), word.size());
  return word.front() == 'n' && end > 1 && (end == word.size() || word[end] == '_');
}

std::string_view word_at(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && is_name_character(text[end])) ++end;
  return text.substr(at, end - at);
}

using Numbering = std::unordered_map<std::string_view, std::size_t>;

// The names of the modules, numbered in their order.
Numbering module_numbers(std::string_view netlist) {
  Numbering numbers;
  for (std::size_t at = 0; (at = netlist.find(c_module_head, at)) != std::string_view::npos;) {
    at += c_module_head.size();
    numbers.try_emplace(word_at(netlist, at), numbers.size());
  }
  return numbers;
}

// The netlist with the numbers of its modules, and of the numbered nets of each module.
std::string numbered(std::string_view netlist) {
  const Numbering modules = module_numbers(netlist);
  Numbering nets;
  std::string text;
  for (std::size_t at = 0; at < netlist.size();) {
    const std::string_view word = word_at(netlist, at);
    at += std::max<std::size_t>(word.size(), 1);
    if (word == "endmodule") nets.clear();
    if (word.empty())
      text += netlist[at - 1];
    else if (const auto module = modules.find(word); module != modules.end())
      text += fmt::format("module{}", module->second);
    else if (is_counted(word))
      text += fmt::format("n{}", nets.try_emplace(word, nets.size()).first->second);
    else
      text += word;
  }
  return text;
}

struct Module {
  std::string text;
  std::vector<std::string> instances{};  // names of their modules
};

// In the order of the netlist. GHDL writes an instance as `  MODULE LABEL (`. Text before the first module is
// dropped.
std::vector<std::pair<std::string, Module>> modules_of(std::string_view netlist) {
  std::vector<std::pair<std::string, Module>> modules;
  std::istringstream lines{std::string(netlist)};
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(c_module_head)) modules.push_back({line.substr(c_module_head.size()), {}});
    if (modules.empty()) continue;
    Module& module = modules.back().second;
    module.text += line + '\n';
    std::istringstream words(line);
    std::string name, label, bracket;
    words >> name >> label >> bracket;
    if (bracket == "(") module.instances.push_back(name);
  }
  return modules;
}

// Add the module and all that it contains.
void add_part(const std::string& name, const std::map<std::string, Module>& modules,
              std::set<std::string>& part) {
  const auto module = modules.find(name);
  if (module == modules.end() || !part.insert(name).second) return;
  for (const std::string& instance : module->second.instances) add_part(instance, modules, part);
}

}  // namespace

std::string netlist_identity(std::string_view netlist) {
  return ContentHash().add(numbered(netlist)).hex();
}

std::set<std::string> part_identities(std::string_view netlist) {
  const auto in_order = modules_of(netlist);
  const std::map<std::string, Module> modules(in_order.begin(), in_order.end());
  std::set<std::string> identities;
  for (const auto& [top, top_module] : in_order) {
    std::set<std::string> part;
    add_part(top, modules, part);
    std::string text;
    for (const auto& [name, module] : in_order)
      if (part.contains(name)) text += module.text;
    identities.insert(netlist_identity(text));
  }
  return identities;
}

}  // namespace halfway::synth

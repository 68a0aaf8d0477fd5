// SPDX-License-Identifier: Apache-2.0
#include "sim/synth/netlist_parts.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <sstream>

namespace halfway::synth {
namespace {

struct Module {
  std::string name, text;
  std::set<std::size_t> inside{};  // indices of the modules that it contains, directly or not
};

// GHDL starts each module with a line `module NAME`. Text before the first module is dropped.
std::vector<Module> modules_of(std::string_view netlist) {
  std::vector<Module> modules;
  std::istringstream lines{std::string(netlist)};
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("module ")) {
      std::istringstream words(line);
      std::string keyword, name;
      words >> keyword >> name;
      modules.push_back({name, ""});
    }
    if (!modules.empty()) modules.back().text += line + '\n';
  }
  return modules;
}

// GHDL writes an instance as `  MODULE LABEL (`.
std::set<std::size_t> instances_in(const Module& module, const std::map<std::string, std::size_t>& numbers) {
  std::set<std::size_t> found;
  std::istringstream lines(module.text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string first, second, third;
    words >> first >> second >> third;
    if (third != "(" || !line.starts_with("  ")) continue;
    if (const auto number = numbers.find(first); number != numbers.end()) found.insert(number->second);
  }
  return found;
}

}  // namespace

std::vector<NetlistPart> parts_of(std::string_view netlist) {
  std::vector<Module> modules = modules_of(netlist);
  std::map<std::string, std::size_t> numbers;
  for (std::size_t i = 0; i < modules.size(); ++i) numbers.emplace(modules[i].name, i);
  for (Module& module : modules) module.inside = instances_in(module, numbers);
  // Add the contents of the contained modules until nothing is added.
  for (bool added = true; added;) {
    added = false;
    for (Module& module : modules)
      for (const std::size_t i : std::set(module.inside)) {
        const std::size_t before = module.inside.size();
        module.inside.insert(modules[i].inside.begin(), modules[i].inside.end());
        added = added || module.inside.size() != before;
      }
  }
  std::vector<NetlistPart> parts;
  for (const Module& module : modules) {
    NetlistPart& part = parts.emplace_back(NetlistPart{module.name, ""});
    for (const std::size_t i : module.inside) part.netlist += modules[i].text;
    part.netlist += module.text;
  }
  return parts;
}

}  // namespace halfway::synth

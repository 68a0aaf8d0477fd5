// SPDX-License-Identifier: Apache-2.0
#include "sim/cost/design.hpp"

#include <fmt/format.h>

#include <unordered_map>

#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/engines/verilator/netlist.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

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

}  // namespace

Design design_of(const HardwareKey& key, const std::filesystem::path& root) {
  return {.name = key.name(),
          .entity = key.entity(),
          .generics = key.generics(),
          .root = root,
          .key = key.name(),
          .has_products = key.shader == Shader::processors};
}

std::string hardware_text(const Design& design) {
  if (!design.key.empty()) return design.key;
  std::string text = design.entity;
  for (const auto& [name, value] : design.generics) text += ' ' + name + '=' + value;
  return text;
}

bool takes_multiplier_bits(std::string_view entity) {
  constexpr std::array<std::string_view, 7> c_entities = {
      "multiplier",       "diffuse_slice", "specular_slice", "spherical_light",
      "spherical_shader", c_stream_top,    c_core_top};
  return std::ranges::find(c_entities, entity) != c_entities.end();
}

std::string netlist_of(const Design& design, const std::filesystem::path& cache) {
  std::vector<VhdlSource> sources = must(read_rtl_sources(design.root));
  if (!design.more.empty()) sources.push_back(must(read_vhdl_source(design.root, design.more)));
  const GhdlLibrary library = must(GhdlLibrary::for_synthesis(must(GhdlTool::find()), sources, cache));
  return must(mend_netlist(must(library.synthesize(design.entity, design.generics))));
}

std::string netlist_identity(std::string_view netlist) {
  return ContentHash().add(numbered(netlist)).hex();
}

}  // namespace halfway::synth

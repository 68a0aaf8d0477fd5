// SPDX-License-Identifier: Apache-2.0
#include "sim/cost/design.hpp"

#include <algorithm>
#include <array>

#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/engines/verilator/netlist.hpp"
#include "sim/os/must.hpp"

namespace halfway::synth {

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

}  // namespace halfway::synth

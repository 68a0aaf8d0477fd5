// SPDX-License-Identifier: Apache-2.0
#include "sim/engines/ghdl/hardware_units.hpp"

#include <algorithm>
#include <sstream>

#include "sim/os/must.hpp"

namespace halfway {

namespace {

// The names of the sources: each file of the RTL contains one entity or package of its name.
std::set<std::string> entities_of(const std::vector<VhdlSource>& sources) {
  std::set<std::string> entities;
  for (const VhdlSource& source : sources) entities.insert(std::filesystem::path(source.name).stem());
  return entities;
}

// The entity of a module of GHDL's netlist: the longest name of an entity that the module's name is, or
// starts with; empty without one. GHDL appends a module's generics to the name of its entity.
std::string entity_of(std::string_view module, const std::set<std::string>& entities) {
  std::string entity;
  for (const std::string& name : entities)
    if ((module == name || module.starts_with(name + "_")) && name.size() > entity.size()) entity = name;
  return entity;
}

bool is_label(std::string_view label, const std::string& name) {
  return label == name || label.starts_with(name + "_");
}

// Instances that implement an effect that the hardware always has.
std::vector<std::string> instances_of(Effect effect, Shader shader) {
  switch (effect) {
    case Effect::depth:
      return {"z_interpolator"};
    case Effect::exponents:
      return {"power"};
    case Effect::ambient:
      // The first processor of the pipeline.
      if (shader == Shader::processors) return {"chain_n1"};
      return {"ambient_light"};
    default:
      return {};
  }
}

UnitCounts difference(UnitCounts counts, const UnitCounts& subtracted) {
  for (const auto& [unit, count] : subtracted) counts[unit] -= count;
  std::erase_if(counts, [](const auto& unit) { return unit.second <= 0; });
  return counts;
}

}  // namespace

// GHDL writes `module NAME` and, indented by two spaces, `MODULE LABEL (`.
InstanceTree::InstanceTree(std::string_view netlist, const std::set<std::string>& entities) {
  std::istringstream lines{std::string(netlist)};
  std::string module;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string first, second, third;
    words >> first >> second >> third;
    if (line.starts_with("module ")) {
      module = second;
    } else if (line.starts_with("  ") && third == "(") {
      const std::string entity = entity_of(first, entities);
      if (!entity.empty()) instances_[module].push_back({first, entity, second});
    }
  }
}

UnitCounts InstanceTree::count(const std::string& top, const std::vector<std::string>& names) const {
  UnitCounts counts;
  add(top, names, counts);
  return counts;
}

void InstanceTree::add(const std::string& module, const std::vector<std::string>& names,
                       UnitCounts& counts) const {
  const auto at = instances_.find(module);
  if (at == instances_.end()) return;
  for (const Instance& instance : at->second) {
    const bool is_counted = names.empty() || std::ranges::any_of(names, [&](const std::string& name) {
                              return instance.entity == name || is_label(instance.label, name);
                            });
    if (is_counted) ++counts[instance.entity];
    add(instance.module, is_counted ? std::vector<std::string>{} : names, counts);
  }
}

Result<UnitCounter> UnitCounter::open(const SimulatorFolders& folders) try {
  const auto sources = must(read_rtl_sources(folders.source));
  return UnitCounter(must(GhdlLibrary::for_synthesis(must(GhdlTool::find()), sources, folders.cache)),
                     entities_of(sources));
} catch (const Failure& failure) {
  return failure.error;
}

InstanceTree UnitCounter::tree(const HardwareKey& key) const {
  return {must(library_.synthesize(key.entity(), key.generics())), entities_};
}

UnitCounts UnitCounter::count(const HardwareKey& key) {
  if (const auto at = counted_.find(key.name()); at != counted_.end()) return at->second;
  return counted_[key.name()] = tree(key).count(key.entity());
}

UnitCounts UnitCounter::count(const HardwareKey& key, const PlannedEffect& effect) {
  if (effect.other) {
    const UnitCounts here = count(key), there = count(*effect.other);
    return effect.elaborated ? difference(here, there) : difference(there, here);
  }
  const std::vector<std::string> names = instances_of(effect.effect, key.shader);
  if (!effect.elaborated || names.empty()) return {};
  return tree(key).count(key.entity(), names);
}

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
#include "mutants/design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>

#include "sim/os/must.hpp"

namespace halfway::mutants {
namespace {

Stream read_stream(const toml::table& table) {
  return {table["port"].value_or(std::string()),    table["file"].value_or(std::string()),
          table["columns"].value_or(std::string()), table["prompt"].value_or(false),
          table["with"].value_or(std::string()),    table["steady"].value_or(std::string())};
}

std::vector<std::string> words_of(const toml::table& table, const char* name) {
  std::istringstream words(text_of(table, name));
  return {std::istream_iterator<std::string>(words), {}};
}

// The columns that the section of an entity in tb/vectors/rows.toml names.
void take_rows(const toml::table& folders, Design& design) {
  for (const auto& [folder, entities] : folders) {
    const toml::table* section = (*entities.as_table())[design.entity].as_table();
    if (section == nullptr) continue;
    design.rows = text_of(*section, "drive") + ' ' + text_of(*section, "check");
    design.skip = section->contains("latency");
  }
}

std::vector<Without> without_of(const toml::table& all) {
  return read_list<Without>(all, "without", [](const toml::table& table) {
    return Without{text_of(table, "name"), text_of(table, "within"), text_of(table, "reason")};
  });
}

// The entities that are tested by themselves.
std::set<std::string> tested_entities(const toml::table& all) {
  std::set<std::string> tested;
  for (const toml::node& entity : *all["entity"].as_array())
    tested.insert(text_of(*entity.as_table(), "name"));
  for (const Without& without : without_of(all))
    if (!without.reason.empty()) tested.insert(without.entity);
  return tested;
}

}  // namespace

std::vector<Survivor> read_survivors(const std::filesystem::path& file) {
  return read_list<Survivor>(read_toml(file), "survivor", [](const toml::table& table) {
    return Survivor{text_of(table, "file"), text_of(table, "text"), text_of(table, "reason")};
  });
}

std::vector<Without> read_without(const std::filesystem::path& file) {
  return without_of(read_toml(file));
}

std::vector<Design> read_designs(const std::filesystem::path& source) {
  std::vector<Design> designs;
  const toml::table all = read_toml(source / "tb/mutants/designs.toml");
  const toml::table testbenches = read_toml(source / "tb/vectors/rows.toml");
  const std::set<std::string> tested = tested_entities(all);
  for (const toml::node& node : *all["entity"].as_array()) {
    const toml::table& entity = *node.as_table();
    Design common;
    common.entity = text_of(entity, "name");
    common.rows = text_of(entity, "rows");
    common.skip = entity["skip"].value_or(0U);
    common.stalled = text_of(entity, "stalled");
    common.reset = entity["reset"].value_or(false);
    common.busy = entity["busy"].value_or(true);
    common.proofs = entity["proofs"].value_or(true);
    if (entity["own_cells"].value_or(false))
      std::ranges::remove_copy(tested, std::back_inserter(common.without_faults), common.entity);
    if (const toml::table* input = entity["input"].as_table()) common.input = read_stream(*input);
    if (!entity.contains("rows") && !entity.contains("input")) take_rows(testbenches, common);
    if (entity.contains("outputs")) common.outputs = read_list<Stream>(entity, "outputs", read_stream);
    for (const toml::node& variant_node : *entity["variants"].as_array()) {
      const toml::table& variant = *variant_node.as_table();
      Design design = common;
      design.name = common.entity + "." + text_of(variant, "name");
      design.faults = variant["faults"].value_or(100U);
      design.quick = variant["quick"].value_or(false);
      for (const std::string& word : words_of(variant, "generics")) {
        const auto equals = word.find('=');
        design.generics.emplace_back("g_" + word.substr(0, equals), word.substr(equals + 1));
      }
      for (const std::string& word : words_of(variant, "sets"))
        design.sets.push_back(common.entity + "/" + word);
      designs.push_back(std::move(design));
    }
  }
  return designs;
}

}  // namespace halfway::mutants

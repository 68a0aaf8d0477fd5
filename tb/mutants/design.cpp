// SPDX-License-Identifier: Apache-2.0
#include "mutants/design.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <sstream>

namespace halfway::mutants {
namespace {

Stream read_stream(const toml::table& table) {
  return {table["port"].value_or(std::string()), table["file"].value_or(std::string()),
          table["columns"].value_or(std::string()), table["prompt"].value_or(false)};
}

/// Reads the file's table. An error names file and line.
Result<toml::table> parse(const std::filesystem::path& file) {
  try {
    return toml::parse_file(file.string());
  } catch (const toml::parse_error& error) {
    return bad_input(fmt::format("{}:{}: {}", file.string(), error.source().begin.line, error.description()));
  }
}

}  // namespace

Result<std::vector<Survivor>> read_survivors(const std::filesystem::path& file) {
  const auto all = parse(file);
  if (!all) return all.error();
  std::vector<Survivor> survivors;
  for (const toml::node& node : *(*all)["survivor"].as_array()) {
    const toml::table& table = *node.as_table();
    const auto text = [&](const char* name) { return table[name].value_or(std::string()); };
    survivors.push_back({text("file"), text("text"), text("reason")});
  }
  return survivors;
}

Result<std::vector<Without>> read_without(const std::filesystem::path& file) {
  const auto all = parse(file);
  if (!all) return all.error();
  std::vector<Without> without;
  for (const toml::node& node : *(*all)["without"].as_array()) {
    const toml::table& table = *node.as_table();
    const auto text = [&](const char* name) { return table[name].value_or(std::string()); };
    without.push_back({text("name"), text("within"), text("reason")});
  }
  return without;
}

Result<std::vector<Design>> read_designs(const std::filesystem::path& file) {
  std::vector<Design> designs;
  const auto all = parse(file);
  if (!all) return all.error();
  for (const toml::node& node : *(*all)["entity"].as_array()) {
    const toml::table& entity = *node.as_table();
    Design common;
    common.entity = entity["name"].value_or(std::string());
    common.rows = entity["rows"].value_or(std::string());
    common.skip = entity["skip"].value_or(0U);
    common.stalled = entity["stalled"].value_or(std::string());
    common.reset = entity["reset"].value_or(false);
    common.proofs = entity["proofs"].value_or(true);
    if (const toml::table* input = entity["input"].as_table()) common.input = read_stream(*input);
    if (const toml::array* outputs = entity["outputs"].as_array())
      for (const toml::node& output : *outputs) common.outputs.push_back(read_stream(*output.as_table()));
    for (const toml::node& variant_node : *entity["variants"].as_array()) {
      const toml::table& variant = *variant_node.as_table();
      Design design = common;
      design.name = common.entity + "." + variant["name"].value_or(std::string());
      design.faults = variant["faults"].value_or(100U);
      design.quick = variant["quick"].value_or(false);
      std::istringstream generics(variant["generics"].value_or(std::string()));
      for (std::string word; generics >> word;) {
        const auto equals = word.find('=');
        design.generics.emplace_back("g_" + word.substr(0, equals), word.substr(equals + 1));
      }
      std::istringstream sets(variant["sets"].value_or(std::string()));
      for (std::string word; sets >> word;) design.sets.push_back(common.entity + "/" + word);
      designs.push_back(std::move(design));
    }
  }
  return designs;
}

}  // namespace halfway::mutants

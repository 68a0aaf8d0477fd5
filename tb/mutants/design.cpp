// SPDX-License-Identifier: Apache-2.0
#include "mutants/design.hpp"

#include <fmt/format.h>

#include <iterator>
#include <sstream>

#include "sim/system/must.hpp"

namespace halfway::mutants {
namespace {

Stream read_stream(const toml::table& table) {
  return {table["port"].value_or(std::string()), table["file"].value_or(std::string()),
          table["columns"].value_or(std::string()), table["prompt"].value_or(false)};
}

std::string text_of(const toml::table& table, const char* name) {
  return table[name].value_or(std::string());
}

std::vector<std::string> words_of(const toml::table& table, const char* name) {
  std::istringstream words(text_of(table, name));
  return {std::istream_iterator<std::string>(words), {}};
}

}  // namespace

toml::table read_toml(const std::filesystem::path& file) {
  try {
    return toml::parse_file(file.string());
  } catch (const toml::parse_error& error) {
    throw Failure{
        bad_input(fmt::format("{}:{}: {}", file.string(), error.source().begin.line, error.description()))};
  }
}

std::vector<Survivor> read_survivors(const std::filesystem::path& file) {
  return read_list<Survivor>(read_toml(file), "survivor", [](const toml::table& table) {
    return Survivor{text_of(table, "file"), text_of(table, "text"), text_of(table, "reason")};
  });
}

std::vector<Without> read_without(const std::filesystem::path& file) {
  return read_list<Without>(read_toml(file), "without", [](const toml::table& table) {
    return Without{text_of(table, "name"), text_of(table, "within"), text_of(table, "reason")};
  });
}

std::vector<Design> read_designs(const std::filesystem::path& file) {
  std::vector<Design> designs;
  const toml::table all = read_toml(file);
  for (const toml::node& node : *all["entity"].as_array()) {
    const toml::table& entity = *node.as_table();
    Design common;
    common.entity = text_of(entity, "name");
    common.rows = text_of(entity, "rows");
    common.skip = entity["skip"].value_or(0U);
    common.stalled = text_of(entity, "stalled");
    common.reset = entity["reset"].value_or(false);
    common.proofs = entity["proofs"].value_or(true);
    if (const toml::table* input = entity["input"].as_table()) common.input = read_stream(*input);
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

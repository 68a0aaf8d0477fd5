// SPDX-License-Identifier: Apache-2.0
#include "sim/cost/yosys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway::synth {

std::string run_tool(std::vector<std::string> arguments, const std::filesystem::path& folder,
                     const std::string& doing, const char* install) {
  const Command command{
      .arguments = std::move(arguments), .working_folder = folder, .timeout = c_tool_timeout};
  const ProcessEnd end = must(run_process(command, install));
  if (end.succeeded()) return end.output;
  throw_tool_failed("{}", failed_text(doing, command, end));
}

std::string version_of(const std::string& tool, const std::string& option, const char* install) {
  const std::string said = run_tool({tool, option}, {}, "looking for " + tool, install);
  return said.substr(0, said.find('\n'));
}

std::filesystem::path kept(const std::filesystem::path& cache, const std::string& name,
                           const std::vector<std::string_view>& key,
                           const std::function<void(const std::filesystem::path&)>& make) {
  ContentHash hash;
  for (const std::string_view text : key) hash.add(text);
  std::filesystem::path folder = cache / fmt::format("{}-{}", name, hash.hex());
  make_once(folder, make);
  return folder;
}

Yosys Yosys::find(const std::filesystem::path& cache) {
  return Yosys(version_of("yosys", "-V"), std::filesystem::absolute(cache));
}

std::filesystem::path Yosys::run(const std::string& name, const std::string& script, const Files& files,
                                 const std::function<void(const std::filesystem::path&)>& check) const {
  std::vector<std::string_view> key{"yosys 1", version_, script};
  for (const auto& [file, text] : files) key.insert(key.end(), {file, text});
  return kept(cache_, name, key, [&](const std::filesystem::path& fresh) {
    for (const auto& [file, text] : files) must(write_file(fresh / file, text));
    run_tool({"yosys", "-q", "-p", script}, fresh, name);
    check(fresh);
  });
}

nlohmann::json read_statistics(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "cells.json";
  const auto whole = nlohmann::json::parse(read_own_file(path), nullptr, false);
  nlohmann::json design = whole.is_object() ? whole.value("design", nlohmann::json()) : nlohmann::json();
  if (design.is_object() && design.value("num_cells_by_type", nlohmann::json()).is_object()) return design;
  throw_tool_failed("{}: not the output of Yosys's stat; delete it and try again", path.string());
}

Cells count_cells(const std::filesystem::path& folder, std::span<const CellKind> kinds) {
  Cells cells;
  const nlohmann::json statistics = read_statistics(folder);
  for (const auto& [type, count] : statistics.at("num_cells_by_type").items()) {
    if (type == "$scopeinfo") continue;  // the name of a flattened module, which Yosys keeps since 0.37
    const auto kind = std::ranges::find_if(
        kinds, [&, &name = type](const CellKind& each) { return name.starts_with(each.prefix); });
    if (kind == kinds.end())
      throw_tool_failed("{}: cells of type {}, which nothing counts", folder.string(), type);
    if (kind->number != nullptr) cells.*kind->number += kind->weight * count.get<std::uint64_t>();
  }
  return cells;
}

}  // namespace halfway::synth

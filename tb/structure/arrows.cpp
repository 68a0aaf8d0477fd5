// SPDX-License-Identifier: Apache-2.0
#include "structure/arrows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

namespace halfway::structure {
namespace {

// Layers of the top folders. A file may include folders of the same or a smaller number.
int layer(std::string_view path) {
  if (path.starts_with("model/")) return 0;
  return path.starts_with("sim/") ? 1 : 2;
}

bool is_test(std::string_view path) {
  return path.ends_with("_test.cpp") || path.ends_with("_test.hpp") || path.find("/test/") != path.npos;
}

// Returns model/setup for model/setup/edge.hpp and for model/setup/test/random_scenes.hpp.
std::string folder_of(const std::string& path) {
  const std::size_t top = path.find('/'), end = path.find('/', top + 1);
  return path.substr(0, end == path.npos ? top : end);
}

// The text between the quotes of an include line; empty for any other line.
std::optional<std::string> included_name(std::string_view line) {
  const auto skip_blanks = [&] { line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size())); };
  skip_blanks();
  if (!line.starts_with('#')) return std::nullopt;
  line.remove_prefix(1);
  skip_blanks();
  if (!line.starts_with("include")) return std::nullopt;
  const std::size_t begin = line.find('"'), end = line.find('"', begin + 1);
  if (begin == line.npos || end == line.npos) return std::nullopt;
  return std::string(line.substr(begin + 1, end - begin - 1));
}

// The included file; empty if it is outside the checkout.
std::optional<std::string> included_file(const Sources& sources, const std::string& file,
                                         const std::string& name) {
  for (const std::string& start :
       {std::string(), std::string("model/"), std::string("tb/"), file.substr(0, file.rfind('/') + 1)})
    if (sources.contains(start + name)) return start + name;
  return std::nullopt;
}

using Graph = std::map<std::string, std::set<std::string>>;

bool reaches(const Graph& graph, const std::string& from, const std::string& to,
             std::set<std::string>& seen) {
  const auto found = graph.find(from);
  if (found == graph.end()) return false;
  for (const std::string& next : found->second)
    if (next == to || (seen.insert(next).second && reaches(graph, next, to, seen))) return true;
  return false;
}

bool on_a_cycle(const Graph& graph, const std::string& folder) {
  std::set<std::string> seen;
  return reaches(graph, folder, folder, seen);
}

}  // namespace

std::vector<std::string> wrong_arrows(const Sources& sources) {
  std::vector<std::string> wrong;
  Graph graph;
  for (const auto& [file, text] : sources) {
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
      const auto name = included_name(line);
      const auto target = name ? included_file(sources, file, *name) : std::nullopt;
      if (!target) continue;
      const auto say = [&, &file = file](std::string_view what) {
        wrong.push_back(fmt::format("{}:{}: includes {}: {}", file, number, *target, what));
      };
      if (target->ends_with(".cpp")) say("share a header instead of a source file");
      if (layer(file) < layer(*target) && !is_test(file)) say("arrows point from tb to sim to model");
      if (is_test(*target) && !is_test(file) && layer(file) < 2) say("only tests may use a test's helpers");
      if (!is_test(file) && folder_of(file) != folder_of(*target))
        graph[folder_of(file)].insert(folder_of(*target));
    }
  }
  std::string cycle;
  for (const auto& [folder, includes] : graph)
    if (on_a_cycle(graph, folder)) cycle += " " + folder;
  if (!cycle.empty())
    wrong.push_back(
        fmt::format("these folders form cycles:{}: move what two of them share below both", cycle));
  return wrong;
}

}  // namespace halfway::structure

// SPDX-License-Identifier: Apache-2.0
#include "sim/bench/readme_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <regex>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/system/page_part.hpp"

namespace halfway {
namespace {

using Cells = std::vector<std::string>;

constexpr std::size_t c_columns = 4;  // of the ways': README leaves the folded processors, the last one, out

// What stands below a heading, up to the next of its kind.
std::string_view section(std::string_view page, const std::string& heading) {
  const std::size_t begin = page.find(fmt::format("\n{}\n", heading));
  if (begin == page.npos) return {};
  const std::string next = "\n" + heading.substr(0, heading.find(' ') + 1);
  return page.substr(begin, page.find(next, begin + 1) - begin);
}

// Of its table, the head first and without the line below it.
std::vector<Cells> rows_of(std::string_view section) {
  std::vector<Cells> rows;
  for (std::size_t at = 0; at < section.size();) {
    std::string_view line = section.substr(at, section.find('\n', at) - at);
    at += line.size() + 1;
    if (!line.starts_with("| ") || line.starts_with("| ---")) continue;
    Cells cells;
    while (line.size() > 1) {
      line.remove_prefix(1);
      const std::size_t end = std::min(line.find('|'), line.size());
      const std::string_view cell = line.substr(0, end);
      const std::size_t first = cell.find_first_not_of(' '), last = cell.find_last_not_of(' ');
      cells.emplace_back(first == cell.npos ? std::string_view() : cell.substr(first, last + 1 - first));
      line.remove_prefix(end);
    }
    rows.push_back(std::move(cells));
  }
  return rows;
}

std::vector<std::string> all_of(std::string_view text, const char* pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::cregex_iterator it(text.data(), text.data() + text.size(), regex), end; it != end; ++it)
    found.push_back((*it)[1]);
  return found;
}

const std::string& larger(const std::string& a, const std::string& b) {
  return std::strtod(a.c_str(), nullptr) < std::strtod(b.c_str(), nullptr) ? b : a;
}

std::string ways_table(const std::vector<Cells>& rows) {
  std::string text;
  for (const Cells& row : rows) {
    if (row.size() < c_columns || row.front().starts_with("frame;")) continue;
    text += fmt::format("| {} |\n", fmt::join(row.begin(), row.begin() + c_columns, " | "));
    if (&row == &rows.front()) text += "| --- | --- | --- | --- |\n";
  }
  return text;
}

// Of our path, the first row, beside the silicon that the papers name.
std::optional<std::string> rates_text(const std::vector<Cells>& ways) {
  const std::regex time(R"(\(([0-9.]+) ns\))");
  std::vector<double> ns;
  for (const Cells& row : ways)
    if (row.size() >= c_columns && row.front().starts_with("RTL in lanes, every field compared"))
      for (const std::string& cell : {row[1], row[2]})
        if (std::smatch found; std::regex_search(cell, found, time)) ns.push_back(std::stod(found[1]));
  if (ns.size() != 2) return {};
  return fmt::format(
      "A core draws and compares {:.0f} million fragments a second of the quadratic shader's RTL, {:.0f} of "
      "the "
      "spherical one's. The papers\npromise 50 and 60 ns a pixel of their silicon, an XCV300, which is 20 "
      "and 17 million.\n\n",
      1e3 / ns[0], 1e3 / ns[1]);
}

// Clocks a fragment at ten pixels a triangle.
std::optional<std::string> clocks_of(const std::vector<Cells>& small, std::string_view shader) {
  for (const Cells& row : small)
    if (row.size() > 3 && row[0] == shader && row[2] == "10.0") return row[3];
  return {};
}

// Of four threads, or as many as there are: ours and the yardstick's.
std::optional<std::pair<std::string, std::string>> cores_of(const std::vector<Cells>& cores,
                                                            std::string_view shader) {
  std::optional<std::pair<std::string, std::string>> found;
  for (const Cells& row : cores)
    if (row.size() > 6 && row[0] == shader && row[1] != "1") found.emplace(row[3], row[5]);
  return found;
}

}  // namespace

Result<ReadmeParts> readme_parts(const std::string& page) {
  const auto lacks = [](const char* what) {
    return bad_input(fmt::format("sim/bench/README.md: has no {}: make bench measures all of it", what));
  };
  const std::vector<std::string> machine = all_of(page, "\nMachine: (\\d+ cores of [^,]+),");
  if (machine.size() != 1) return lacks("machine");
  const std::vector<Cells> way_rows = rows_of(section(page, "## Ways to a picture"));
  const std::string ways = ways_table(way_rows);
  const auto rates = rates_text(way_rows);
  if (std::ranges::count(ways, '\n') < 10 || !rates) return lacks("ways to a picture");
  const std::string_view growth = section(page, "## Growth");
  // Triangles, pixels, lights, two shaders each.
  const std::vector<std::string> beside = all_of(growth, "at most ([0-9.]+) % beside that line");
  if (beside.size() != 6) return lacks("six lines of growth");
  // Pixels, two shaders.
  const std::vector<std::string> with_lines = all_of(growth, "are at most ([0-9.]+) % beside these");
  if (with_lines.size() != 2) return lacks("growth with pixels and lines");
  std::vector<std::string> memory;
  for (const char* shader : {"quadratic", "spherical"}) {
    const auto rows = rows_of(section(growth, fmt::format("### Triangles, {} shader", shader)));
    if (rows.size() < 2) return lacks("growth with triangles");
    memory.push_back(rows.back().back());
  }
  const std::vector<Cells> small = rows_of(section(page, "## Small triangles"));
  const auto quadratic = clocks_of(small, "quadratic"), spherical = clocks_of(small, "spherical"),
             processors = clocks_of(small, "processors");
  if (!quadratic || !spherical || quadratic != processors) return lacks("clocks at ten pixels a triangle");
  const std::vector<Cells> cores = rows_of(section(page, "## Cores"));
  const auto quadratic_core = cores_of(cores, "quadratic"), spherical_core = cores_of(cores, "spherical");
  if (!quadratic_core || !spherical_core) return lacks("cores beside a yardstick");
  const std::string_view end = section(page, "## End to end");
  const std::vector<std::string> seconds = all_of(end, "best of three: ([0-9.]+) s"),
                                 line = all_of(end, "\n```\n([^\n]+\n)```\n");
  if (seconds.size() != 1 || line.size() != 1) return lacks("time of make sim");
  const std::string_view view = section(page, "## View");
  const std::size_t table = view.find("\n| ");
  if (table == view.npos || rows_of(view).size() < 2) return lacks("frames of view");
  ReadmeParts parts;
  parts.view = fmt::format("On {}:\n{}", machine[0], view.substr(table));
  const std::string most = larger(memory[0], memory[1]);
  parts.speed = fmt::format(
      R"(On {}:

{}
{}On {} threads each core is {} (quadratic) and {} (spherical) as fast as one alone, where work in registers alone,
which shares nothing, is {} and {}.

Time grows with triangles (10³ to 10⁷), with pixels (10⁴ to 1.6·10⁷, setup apart) and with lights (1 to 16) within
{}, {} and {} % of a line and a constant; with pixels within {} % where each line of a triangle is given a time, too.
A mesh of ten million triangles at 1000×1000 takes {} MiB beside itself, {} of them the frame. At ten pixels a triangle
a fragment costs the hardware {} clocks (quadratic, processors) and {} (spherical, for its headers); elsewhere lines
without a pixel and triangles of a single one are what is lost.

`make sim SCENE=spheres` on an unchanged tree takes {} s, all of it, the best of three.
)",
      machine[0], ways, *rates, cores.back()[1], quadratic_core->first, spherical_core->first,
      quadratic_core->second, spherical_core->second, larger(beside[0], beside[1]),
      larger(beside[2], beside[3]), larger(beside[4], beside[5]), larger(with_lines[0], with_lines[1]),
      most.substr(0, most.find(' ')), most.substr(most.find('(') + 1, most.find(')') - most.find('(') - 1),
      *quadratic, *spherical, seconds[0]);
  parts.sim_line = fmt::format("```\n{}```\n", line[0]);
  return parts;
}

Result<std::string> with_readme_parts(const std::string& readme, const ReadmeParts& parts) {
  Result<std::string> text = readme;
  for (const auto& [name, part] :
       {std::pair{"speed", &parts.speed}, {"sim line", &parts.sim_line}, {"view", &parts.view}})
    if (text) text = with_page_part(*text, name, *part);
  return text;
}

}  // namespace halfway

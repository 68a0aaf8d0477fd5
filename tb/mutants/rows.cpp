// SPDX-License-Identifier: Apache-2.0
#include "mutants/rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "evidence/inputs.hpp"
#include "sim/ghdl/rtl_hash.hpp"
#include "sim/pages/template.hpp"
#include "sim/synth/nameless_netlist.hpp"
#include "sim/system/file.hpp"

namespace halfway::mutants {
namespace {

constexpr std::size_t c_shown = 3;  // survivors of a VHDL line that the page names

using Cells = std::vector<std::string>;

Cells words_of(const std::string& line, char separator) {
  Cells words;
  std::istringstream stream(line);
  for (std::string word; std::getline(stream, word, separator);) words.push_back(word);
  return words;
}

// Adds the files of the folder, sorted by name.
Status add_files(const std::filesystem::path& folder, ContentHash& hash) {
  const auto files = files_below(folder);
  if (!files) return files.error();
  for (const auto& file : *files) {
    const auto text = read_file(folder / file);
    if (!text) return text.error();
    hash.add(file.string()).add(*text);
  }
  return Ok{};
}

// The named source and all that it uses by `work.NAME`, each once.
void add_used(const std::string& text, const std::map<std::string, const VhdlSource*>& units,
              std::set<std::string>& added, ContentHash& hash) {
  static const std::regex c_use(R"(\bwork\.(\w+))");
  hash.add(text);
  for (std::sregex_iterator at(text.begin(), text.end(), c_use), last; at != last; ++at) {
    const auto unit = units.find((*at)[1]);
    if (unit != units.end() && added.insert(unit->second->name).second)
      add_used(bare_vhdl(unit->second->content), units, added, hash);
  }
}

Result<std::vector<VhdlSource>> all_sources(const std::filesystem::path& source) {
  auto sources = read_rtl_sources(source);
  if (!sources) return sources;
  const auto files = files_below(source / "tb", ".vhd");
  if (!files) return files.error();
  for (const auto& file : *files) {
    auto one = read_vhdl_source(source, (std::filesystem::path("tb") / file).string());
    if (!one) return one.error();
    sources->push_back(std::move(*one));
  }
  return sources;
}

// A row of numbers, summed over rows.
using Sum = std::array<unsigned long, 4>;  // faults, found, equivalent, survived

void add(Sum& sum, const Cells& cells, std::size_t first) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += std::stoul(cells.at(first + i));
}
Cells row_of(const std::string& name, const Sum& sum) {
  Cells cells{name};
  for (const unsigned long count : sum) cells.push_back(std::to_string(count));
  return cells;
}

}  // namespace

Result<std::string> programs_hash(const std::filesystem::path& source) {
  constexpr std::string_view c_tools[] = {"ghdl", "yosys", "verilator"};
  const auto versions = evidence::versions(c_tools);
  if (!versions) return versions.error();
  ContentHash hash;
  hash.add(*versions);
  for (const char* file : {"netlist_faults.cpp", "replay.cpp", "model_harness.cpp", "source_faults.cpp"}) {
    const auto text = read_file(source / "tb/mutants" / file);
    if (!text) return text.error();
    hash.add(file).add(evidence::bare_cpp(*text));
  }
  return hash.hex();
}

Result<std::string> design_hash(const Design& design, const GhdlLibrary& library, const RowFolders& folders,
                                std::string_view programs) {
  const auto netlist = library.synthesize(design.entity, design.generics);
  if (!netlist) return netlist.error();
  ContentHash hash;
  hash.add("mutants 1").add(programs).add(synth::nameless(*netlist)).add(design.rows).add(design.stalled);
  hash.add(fmt::format("{} {} {}", design.faults, design.skip, design.reset));
  std::vector<Stream> streams{design.input};
  streams.insert(streams.end(), design.outputs.begin(), design.outputs.end());
  for (const Stream& stream : streams)
    hash.add(stream.port).add(stream.file).add(stream.columns).add(stream.prompt ? "prompt" : "");
  if (!design.rows.empty()) streams = {Stream{}};
  for (const std::string& set : design.sets)
    for (const Stream& stream : streams) {
      const auto text = read_file(folders.vectors / (set + stream.file + ".txt"));
      if (!text) return text.error();
      hash.add(set).add(*text);
    }
  return hash.hex();
}

Result<std::string> testbench_hash(const std::string& test, std::span<const SourceFault> faults,
                                   const RowFolders& folders, std::string_view programs) {
  const auto sources = all_sources(folders.source);
  if (!sources) return sources.error();
  static const std::regex c_unit(R"((?:^|\n)(?:entity|package)\s+(\w+)\s+is)");
  std::map<std::string, const VhdlSource*> units;
  for (const VhdlSource& source : *sources)
    for (std::sregex_iterator at(source.content.begin(), source.content.end(), c_unit), last; at != last;
         ++at)
      units[(*at)[1]] = &source;
  const auto testbench = units.find(test + "_tb");
  if (testbench == units.end())
    return bad_input(fmt::format("source_faults.toml: {}: there is no testbench of this name", test));
  ContentHash hash;
  hash.add("sources 1").add(programs);
  std::set<std::string> added{testbench->second->name};
  add_used(bare_vhdl(testbench->second->content), units, added, hash);
  for (const SourceFault& fault : faults)
    if (fault.test == test)
      hash.add(fault.file)
          .add(fault.old_text)
          .add(fault.new_text)
          .add(fmt::format("{} {} {}", fault.line, fault.word, fault.in_vectors));
  if (const Status done = add_files(folders.vectors / test, hash); !done) return done.error();
  return hash.hex();
}

Result<Reasons> Reasons::read(const std::filesystem::path& source) {
  const auto listed = read_survivors(source / "tb/mutants/survivors.toml");
  if (!listed) return listed.error();
  return Reasons(source, *listed);
}

std::string Reasons::line_at(const std::string& place) const {
  const auto colon = place.find(':');
  if (colon == std::string::npos) return {};
  const std::string file = place.substr(0, colon);
  const auto text = read_file(source_ / "rtl" / file);
  if (!text) return {};
  std::istringstream lines(*text);
  std::string line;
  for (int number = std::stoi(place.substr(colon + 1)); number > 0 && std::getline(lines, line); --number)
    continue;
  line = line.substr(0, line.find("--"));
  const std::size_t begin = line.find_first_not_of(' '), end = line.find_last_not_of(' ');
  return begin == std::string::npos ? file : fmt::format("{}: {}", file, line.substr(begin, end + 1 - begin));
}

std::string Reasons::of(std::string_view line) const {
  for (const Survivor& survivor : listed_)
    if (line.starts_with(survivor.file + ":") && line.find(survivor.text) != std::string_view::npos)
      return survivor.reason;
  return {};
}

std::vector<page::Section> mutant_sections(std::span<const evidence::Row> rows, const Reasons& reasons) {
  constexpr std::size_t c_first_count = 2;  // of a row's fields
  std::vector<Cells> netlists, testbenches, kind_rows, survivor_rows;
  Cells columns, testbench_columns;
  Sum all{};
  std::map<std::string, Sum> kinds;
  std::map<std::pair<std::string, std::string>, Cells> survivors;
  for (const evidence::Row& row : rows) {
    const bool is_netlist = row.section == c_netlist_section;
    Cells names, cells;
    for (const auto& [key, value] : row.fields) {
      names.push_back(key);
      cells.push_back(value);
    }
    (is_netlist ? netlists : testbenches).push_back(cells);
    (is_netlist ? columns : testbench_columns) = names;
    if (!is_netlist) continue;
    add(all, cells, c_first_count);
    for (const std::string& line : words_of(row.details, '\n')) {
      const Cells words = words_of(line, '\t');
      if (words.at(0) == c_kind)
        add(kinds[words.at(1)], words, 2);
      else
        survivors[{words.at(1), row.name}].push_back(words.at(2));
    }
  }
  if (netlists.empty()) return {};
  Cells sum = row_of("**all**", all);
  sum.insert(sum.begin() + 1, "");
  sum.resize(columns.size());
  netlists.push_back(sum);
  for (const auto& [kind, counts] : kinds) kind_rows.push_back(row_of(kind, counts));
  for (const auto& [at, texts] : survivors) {
    std::string shown = fmt::format(
        "{}", fmt::join(texts.begin(),
                        texts.begin() + static_cast<std::ptrdiff_t>(std::min(texts.size(), c_shown)), "; "));
    if (texts.size() > c_shown) shown += fmt::format("; {} more", texts.size() - c_shown);
    survivor_rows.push_back({at.first.empty() ? "not known" : "`" + at.first + "`", "`" + at.second + "`",
                             std::to_string(texts.size()), "`" + shown + "`", reasons.of(at.first)});
  }
  const unsigned long possible = all[0] - all[2];
  const Cells kind_columns{"kind", "faults", "found", "equivalent", "survived"};
  const Cells survivor_columns{"VHDL line", "netlist", "faults", "number, kind, port, wire", "reason"};
  std::vector<page::Section> sections{
      {std::string(c_netlist_section),
       fmt::format("Of the {} faults that are not proved equivalent, the vectors find {:.1f} %.\n\n{}\n{}",
                   possible,
                   100.0 * static_cast<double>(all[1]) / static_cast<double>(std::max(possible, 1UL)),
                   markdown_table(columns, netlists), markdown_table(kind_columns, kind_rows))}};
  if (!testbenches.empty())
    sections.push_back({std::string(c_source_section), markdown_table(testbench_columns, testbenches)});
  sections.push_back({"Survivors", markdown_table(survivor_columns, survivor_rows)});
  return sections;
}

}  // namespace halfway::mutants

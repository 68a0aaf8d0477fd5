// SPDX-License-Identifier: Apache-2.0
// halfway_synth: cells of the listed designs on two FPGA families by Yosys, and their clocks on an iCE40 HX8K
// by nextpnr. Prints them and compares them with tb/evidence/thresholds.toml; with --page, writes the pages
// of evidence `cells` and `clocks`.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "designs.hpp"
#include "evidence/measured.hpp"
#include "performance.hpp"
#include "sim/cost/clock_store.hpp"
#include "sim/cost/netlist_identity.hpp"
#include "sim/cost/synthesis.hpp"
#include "sim/files/page_part.hpp"
#include "sim/os/must.hpp"
#include "sim/os/program.hpp"
#include "sim/os/threads.hpp"
#include "sim/study/hardware.hpp"

namespace halfway::synth {
namespace {

using page::Row;

constexpr const char* c_page = "docs/results/synthesis.md";
constexpr const char* c_none = "–";
constexpr const char* c_cells_section = "Cells";
constexpr const char* c_clocks_section = "Clocks";
constexpr const char* c_studies_section = "Clocks of the hardware of studies";  // without thresholds

// The spaces whose hardware has stored clocks, and their scene.
constexpr const char* c_spaces[] = {"sim/study/spaces/small.toml", "sim/study/spaces/times.toml",
                                    "sim/study/spaces/tables.toml", "sim/study/spaces/one_step.toml"};
constexpr const char* c_space_scene = "sim/study/spaces/sphere.toml";

struct Options {
  SimulatorFolders folders{".", {}};
  std::string part{};
  bool quick = false, page = false;
  unsigned jobs = 2, seeds = 0;
};

struct Item {
  std::string name;
  std::function<Row()> measure;
};
using Values = std::function<std::vector<page::Value>(std::span<const Row>)>;

// Measure the items and print a line for each. `take` is called for one item at a time.
void measure(const std::vector<Item>& items, unsigned jobs,
             const std::function<void(std::size_t, const Row&)>& take) {
  page::Countdown countdown(items.size());
  std::mutex mutex;
  must_for_each(jobs, items.size(), [&](std::size_t i) {
    const Row row = items[i].measure();
    std::vector<std::string> texts;
    for (const auto& [column, text] : row.fields) texts.push_back(fmt::format("{} {}", column, text));
    const std::lock_guard lock(mutex);
    fmt::print("{} {}\n", countdown.next(), fmt::join(texts, ", "));
    std::fflush(stdout);
    take(i, row);
  });
}

// Print the rows as tables, and each threshold that one breaks.
ExitCode print(const Options& options, const std::vector<Item>& items, const Values& values) {
  std::vector<Row> rows(items.size());
  measure(items, options.jobs, [&](std::size_t i, const Row& row) { rows[i] = row; });
  for (const page::Section& section : page::sections_of(rows)) fmt::print("\n{}\n", section.body);
  const auto thresholds = must(page::Thresholds::read(options.folders.source));
  ExitCode end = ExitCode::equal;
  for (const page::Value& value : values(rows))
    for (const std::string& broken : thresholds.broken(value)) {
      cli::say(broken);
      end = ExitCode::differs;
    }
  return end;
}

ExitCode write_page(const Options& options, const char* name, std::vector<Item> items,
                    std::vector<std::string_view> tools, const Values& values) {
  page::Page page{
      .name = name, .root = options.folders.source, .file = c_page, .tools = std::move(tools), .rows = {}};
  page.values = values;
  for (const Item& item : items) page.rows.push_back(item.name);
  const auto journal = must(page::Measured::open(std::move(page)));
  std::erase_if(items, [&](const Item& item) { return journal.has(item.name); });
  measure(items, options.jobs, [&](std::size_t, const Row& row) { must(journal.put(row)); });
  return must(journal.finish());
}

// The listed designs that the options select.
std::vector<ListedDesign> selected(const Options& options) {
  std::vector<ListedDesign> designs = all_designs();
  std::erase_if(designs, [&](const ListedDesign& listed) {
    return (options.quick && !listed.quick) || listed.design.name.find(options.part) == std::string::npos;
  });
  if (designs.empty())
    throw Failure{
        bad_input(fmt::format("{}: no design has this in its name; {} lists them", options.part, c_page))};
  return designs;
}

std::string quoted(const std::string& name) {
  return fmt::format("`{}`", name);
}

// ---- Cells

Row cells_row(const Synthesizer& synthesizer, const ListedDesign& listed, bool with_ecp5) {
  Row row{.name = listed.design.name,
          .section = c_cells_section,
          .fields = {{"design", quoted(listed.design.name)}}};
  const auto add = [&](const char* column, std::uint64_t cells, bool exists) {
    row.fields.emplace_back(column, exists ? std::to_string(cells) : c_none);
  };
  const Ice40Cells ice40 = listed.ice40 ? synthesizer.ice40(listed.design) : Ice40Cells{};
  add("LUTs", ice40.luts, listed.ice40);
  add("carries", ice40.carries, listed.ice40);
  add("flip-flops", ice40.flip_flops, listed.ice40);
  add("RAMs", ice40.rams, listed.ice40);
  if (!with_ecp5) return row;
  const Ecp5Cells ecp5 = synthesizer.ecp5(listed.design);
  add("ECP5: LUTs", ecp5.luts, true);
  add("ECP5: flip-flops", ecp5.flip_flops, true);
  add("ECP5: RAMs", ecp5.rams, true);
  add("ECP5: multipliers", ecp5.multipliers, true);
  return row;
}

std::vector<page::Value> cells_values(std::span<const Row> rows) {
  std::vector<page::Value> values;
  for (const Row& row : rows)
    if (row.field("LUTs") != c_none)
      values.push_back(
          {"cells",
           row.name,
           {std::stod(row.field("LUTs")), std::stod(row.field("flip-flops")), std::stod(row.field("RAMs"))}});
  return values;
}

ExitCode cells(const Options& options) {
  const std::vector<ListedDesign> designs = selected(options);
  const Synthesizer synthesizer = Synthesizer::open(options.folders, false, {c_accumulator});
  std::vector<Item> items;
  for (const ListedDesign& listed : designs)
    items.push_back({listed.design.name, [&] { return cells_row(synthesizer, listed, !options.quick); }});
  return options.page ? write_page(options, "cells", std::move(items), {"ghdl", "yosys"}, cells_values)
                      : print(options, items, cells_values);
}

// ---- Clocks

// Hardware to place.
struct Placed {
  std::shared_ptr<const Synthesizer> synthesizer;
  Design design;
  const char* section;
};

std::string path_text(const CriticalPath& path) {
  return fmt::format("`{}` → `{}`: {} LUTs, {} carries, {:.1f} ns in cells, {:.1f} ns in wires", path.from,
                     path.to, path.luts, path.carries, path.logic, path.routing);
}

Row clock_row(const Placed& placed, const Clock& clock) {
  const std::string& name = placed.design.name;
  const Placement* median = clock.median();
  const auto published = published_ns(name);
  Row row{.name = name, .section = placed.section, .fields = {{"design", quoted(name)}}};
  const auto add = [&](const char* column, const std::string& text) {
    row.fields.emplace_back(column, text);
  };
  add("clock, MHz", median != nullptr ? fmt::format("{:.1f}", median->mhz) : c_none);
  add("seeds, MHz",
      median != nullptr
          ? fmt::format("{:.0f} to {:.0f} of {}{}", clock.placements.front().mhz, clock.placements.back().mhz,
                        clock.placements.size(),
                        clock.endless > 0 ? fmt::format("; nextpnr does not end: {}", clock.endless) : "")
          : c_none);
  add("ns per pixel", median != nullptr ? fmt::format("{:.1f}", 1000 / median->mhz) : c_none);
  add("paper, ns", published ? std::to_string(*published) : c_none);
  add("critical path", median != nullptr ? path_text(median->path) : "not placed: " + clock.none);
  return row;
}

std::vector<page::Value> clock_values(std::span<const Row> rows) {
  std::vector<page::Value> values;
  for (const Row& row : rows)
    if (row.section == c_clocks_section && row.field("clock, MHz") != c_none)
      values.push_back({"clocks", row.name, {std::stod(row.field("clock, MHz"))}});
  return values;
}

std::vector<Placed> listed_hardware(const Options& options) {
  const auto synthesizer =
      std::make_shared<const Synthesizer>(Synthesizer::open(options.folders, true, {c_accumulator}));
  std::vector<Placed> hardware;
  for (const ListedDesign& listed : selected(options))
    if (listed.ice40) hardware.push_back({synthesizer, listed.design, c_clocks_section});
  return hardware;
}

// Add the hardware of the spaces whose netlist no listed design has.
void add_hardware_of_spaces(const SimulatorFolders& folders, std::vector<Placed>& hardware) {
  std::set<std::string> netlists;
  const auto is_new = [&](const Placed& placed) {
    return netlists.insert(netlist_identity(placed.synthesizer->netlist(placed.design))).second;
  };
  for (const Placed& placed : hardware) is_new(placed);
  for (const char* space : c_spaces) {
    const auto points = study::read_space(folders.source / space);
    for (const study::HardwareSource& source :
         study::hardware_of_space((folders.source / c_space_scene).string(), points, folders)) {
      // Those of preset exact are much too large for the device and slow to synthesize.
      const HardwareKey& key = source.hardware.key;
      if (key.shader == Shader::processors && key.preset == Preset::exact) continue;
      Placed placed{std::make_shared<const Synthesizer>(Synthesizer::open(source.folders, true)),
                    source.design(), c_studies_section};
      if (is_new(placed)) hardware.push_back(std::move(placed));
    }
  }
}

// If the command line gives no number: that of the stored clock.
unsigned seeds_of(const Options& options, const ClockStore& clocks, const std::string& name) {
  const auto stored = clocks.find(name);
  if (options.seeds > 0) return options.seeds;
  return stored != clocks.end() && stored->second.seeds > 0 ? stored->second.seeds : c_seeds;
}

StoredClock to_store(const Placed& placed, const Clock& clock) {
  const Placement* median = clock.median();
  return {.cells = placed.synthesizer->ice40(placed.design),
          .mhz = median != nullptr ? median->mhz : 0,
          .seeds = static_cast<unsigned>(clock.placements.size()),
          .tools = placed.synthesizer->versions(),
          .netlist = netlist_identity(placed.synthesizer->netlist(placed.design))};
}

// Remove clocks of other hardware, and write what the pages show of the rest.
void finish(const Options& options, const std::vector<Placed>& hardware, ClockStore& clocks) {
  std::set<std::string> names;
  for (const Placed& placed : hardware) names.insert(placed.design.name);
  std::erase_if(clocks, [&](const auto& clock) { return !names.contains(clock.first); });
  must(write_clocks(options.folders.source, clocks));
  must(rewrite_page(options.folders.source / "docs/performance.md", [&](const std::string& page) {
    return with_page_part(page, "clocks", performance_table(clocks));
  }));
}

ExitCode clocks(const Options& options) {
  std::vector<Placed> hardware = listed_hardware(options);
  if (options.page) add_hardware_of_spaces(options.folders, hardware);
  ClockStore stored = must(read_clocks(options.folders.source));
  std::mutex mutex;
  std::vector<Item> items;
  for (const Placed& placed : hardware)
    items.push_back({placed.design.name, [&, seeds = seeds_of(options, stored, placed.design.name)] {
                       const Clock clock = placed.synthesizer->clock(placed.design, seeds);
                       if (options.page) {
                         StoredClock measured = to_store(placed, clock);
                         const std::lock_guard lock(mutex);
                         stored[placed.design.name] = std::move(measured);
                         must(write_clocks(options.folders.source, stored));
                       }
                       return clock_row(placed, clock);
                     }});
  if (!options.page) return print(options, items, clock_values);
  const ExitCode end =
      write_page(options, "clocks", std::move(items), {"ghdl", "yosys", "nextpnr-ice40"}, clock_values);
  finish(options, hardware, stored);
  return end;
}

}  // namespace
}  // namespace halfway::synth

int main(int argc, char** argv) {
  using namespace halfway;
  synth::Options options;
  CLI::App app{"Cells on two FPGA families, and the clock on an iCE40 HX8K", "halfway_synth"};
  app.require_subcommand(1);
  int exit_code = 0;
  const auto add = [&](const char* name, const char* help, ExitCode (*run)(const synth::Options&)) {
    CLI::App* command = app.add_subcommand(name, help);
    auto* part = command->add_option("PART", options.part, "only designs whose names contain it");
    command->add_flag("--quick", options.quick, "only small designs; cells: only on the iCE40");
    command->add_flag("--page", options.page, "write the page of evidence of this name")
        ->excludes("--quick")
        ->excludes(part);
    command->add_option("--jobs", options.jobs, "at a time")
        ->check(CLI::Range(1, 999))
        ->capture_default_str();
    command->add_option("--source", options.folders.source, "the project's root (the current folder)");
    command->callback([&options, &exit_code, run] {
      options.folders.source = std::filesystem::absolute(options.folders.source);
      options.folders.cache = options.folders.source / "build" / "cache";
      exit_code = static_cast<int>(run(options));
    });
    return command;
  };
  add("cells", "cells on iCE40 and ECP5", synth::cells);
  add("clocks", "clocks on an iCE40 HX8K: minutes for each design", synth::clocks)
      ->add_option("--seeds", options.seeds, "of placement (as stored, or 3)")
      ->check(CLI::Range(1, 999));
  return cli::run_program(app, argc, argv, exit_code);
}

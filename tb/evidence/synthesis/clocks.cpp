// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <mutex>
#include <set>
#include <string>

#include "designs.hpp"
#include "pages.hpp"
#include "sim/cost/netlist_identity.hpp"
#include "sim/cost/synthesis.hpp"
#include "sim/files/page_part.hpp"
#include "sim/os/must.hpp"
#include "sim/study/hardware.hpp"

namespace halfway::synth {
namespace {

constexpr const char* c_clocks_section = "Clocks";
// Without thresholds.
constexpr const char* c_studies_section = "Clocks of the hardware of studies";
constexpr const char* c_ecp5_section = "Clocks on the ECP5 LFE5U-85F";

// The spaces whose hardware has stored clocks, and their scene.
constexpr const char* c_spaces[] = {"sim/study/spaces/small.toml", "sim/study/spaces/times.toml",
                                    "sim/study/spaces/tables.toml", "sim/study/spaces/one_step.toml"};
constexpr const char* c_space_scene = "sim/study/spaces/sphere.toml";

struct Placed {
  Design design;
  const char* section;
};

std::string path_text(const CriticalPath& path) {
  const std::string products = path.multipliers > 0 ? fmt::format(" {} multipliers,", path.multipliers) : "";
  return fmt::format("`{}` → `{}`: {} LUTs, {} carries,{} {:.1f} ns in cells, {:.1f} ns in wires", path.from,
                     path.to, path.luts, path.carries, products, path.logic, path.routing);
}

void add_cells(const Cells& cells, const Family& family, page::Row& row) {
  for (const CellColumn& column : family.columns)
    row.fields.emplace_back(column.title, std::to_string(cells.*column.number));
}

page::Row clock_row(const Placed& placed, const Clock& clock) {
  const std::string& name = placed.design.name;
  const Placement* median = clock.median();
  const auto published = published_ns(name);
  page::Row row{.name = name, .section = placed.section, .fields = {{"design", quoted(placed.design)}}};
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

std::vector<page::Value> values(std::span<const page::Row> rows) {
  std::vector<page::Value> values;
  for (const page::Row& row : rows)
    if (row.section == c_clocks_section && row.field("clock, MHz") != c_none)
      values.push_back({"clocks", row.name, {std::stod(row.field("clock, MHz"))}});
  return values;
}

bool is_on_ecp5(const Options& options) {
  return options.device == c_ecp5.name;
}

std::vector<Placed> hardware_of(const Options& options) {
  std::vector<Placed> hardware;
  for (const ListedDesign& listed : selected(options))
    if (is_on_ecp5(options))
      hardware.push_back({listed.design, c_ecp5_section});
    else if (listed.ice40)
      hardware.push_back({listed.design, c_clocks_section});
  return hardware;
}

std::string identity_of(const Design& design, const Options& options) {
  return netlist_identity(netlist_of(design, options.folders.cache));
}

// Add the hardware of the spaces whose netlist no listed design has.
void add_hardware_of_spaces(const Options& options, std::vector<Placed>& hardware) {
  const SimulatorFolders& folders = options.folders;
  std::set<std::string> netlists;
  for (const Placed& placed : hardware) netlists.insert(identity_of(placed.design, options));
  for (const char* space : c_spaces) {
    auto points = study::read_space(folders.source / space);
    // Pipelines of preset exact are much too large for the device and slow to synthesize.
    std::erase_if(points, [](const study::DesignPoint& point) {
      return point.preset == Preset::exact &&
             (point.method == study::Method::processors_1 || point.method == study::Method::processors_2);
    });
    for (Design& design :
         study::hardware_of_space((folders.source / c_space_scene).string(), points, folders))
      if (netlists.insert(identity_of(design, options)).second)
        hardware.push_back({std::move(design), c_studies_section});
  }
}

// If the command line gives no number: that of the stored clock.
unsigned seeds_of(const Options& options, const ClockStore& clocks, const std::string& name) {
  const auto stored = clocks.find(name);
  if (options.seeds > 0) return options.seeds;
  return stored != clocks.end() && stored->second.seeds > 0 ? stored->second.seeds : c_seeds;
}

StoredClock to_store(const Synthesizer& synthesizer, const Design& design, const Clock& clock,
                     const Options& options) {
  const Placement* median = clock.median();
  return {.cells = synthesizer.cells(design, c_ice40),
          .mhz = median != nullptr ? median->mhz : 0,
          .seeds = static_cast<unsigned>(clock.placements.size()),
          .tools = synthesizer.versions(),
          .netlist = identity_of(design, options),
          .hardware = hardware_text(design)};
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

}  // namespace

ExitCode clocks(const Options& options) {
  std::vector<Placed> hardware = hardware_of(options);
  if (options.page) add_hardware_of_spaces(options, hardware);
  const Family& family = is_on_ecp5(options) ? c_ecp5 : c_ice40;
  const Synthesizer synthesizer = Synthesizer::open(options.folders.cache, true, family);
  ClockStore stored = must(read_clocks(options.folders.source));
  std::mutex mutex;
  std::vector<Item> items;
  for (const Placed& placed : hardware)
    items.push_back({placed.design.name, [&, seeds = seeds_of(options, stored, placed.design.name)] {
                       const Clock clock = synthesizer.clock(placed.design, seeds);
                       if (options.page) {
                         StoredClock measured = to_store(synthesizer, placed.design, clock, options);
                         const std::lock_guard lock(mutex);
                         stored[placed.design.name] = std::move(measured);
                         must(write_clocks(options.folders.source, stored));
                       }
                       page::Row row = clock_row(placed, clock);
                       if (!options.page) add_cells(synthesizer.cells(placed.design, family), family, row);
                       return row;
                     }});
  const ExitCode end =
      measure(options, {"clocks", {"ghdl", "yosys", "nextpnr-ice40"}, values}, std::move(items));
  if (options.page) finish(options, hardware, stored);
  return end;
}

}  // namespace halfway::synth

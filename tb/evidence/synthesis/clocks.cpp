// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <mutex>
#include <set>
#include <string>

#include "designs.hpp"
#include "measure.hpp"
#include "sim/cost/synthesis.hpp"
#include "sim/os/must.hpp"
#include "sim/os/page_part.hpp"
#include "sim/study/hardware.hpp"

namespace halfway::synth {
namespace {

// The sections of clocks with thresholds, and of the others.
struct Sections {
  const Family& family;
  const char *judged, *others, *thresholds;
};
constexpr Sections c_sections[] = {
    {c_ice40, "Clocks", "Clocks of the hardware of studies", "clocks"},
    {c_ecp5, "Clocks on the ECP5 LFE5U-85F", "Other clocks on the ECP5 LFE5U-85F", "clocks_ecp5"}};

// The spaces whose hardware has stored clocks, and their scenes: files beside them, or built in.
constexpr const char* c_spaces = "sim/study/spaces";
constexpr std::pair<const char*, const char*> c_studies[] = {
    {"small.toml", "sphere.toml"},    {"times.toml", "sphere.toml"},      {"tables.toml", "sphere.toml"},
    {"one_step.toml", "sphere.toml"}, {"colour.toml", "red_sphere.toml"}, {"designs.toml", "spheres"}};

struct Placed {
  Design design;
  const char* section;
  unsigned seeds = 0;  // 0: as stored, or c_seeds
};

// The hardware that is placed on a family's device, and its stored clocks.
struct Bench {
  const Family& family;
  Synthesizer synthesizer;
  std::vector<Placed> hardware;
  ClockStore stored;
};

std::string path_text(const CriticalPath& path) {
  const std::string products = path.multipliers > 0 ? fmt::format(" {} multipliers,", path.multipliers) : "";
  return fmt::format("`{}` → `{}`: {} LUTs, {} carries,{} {:.1f} ns in cells, {:.1f} ns in wires", path.from,
                     path.to, path.luts, path.carries, products, path.logic, path.routing);
}

std::string row_name(const Placed& placed, const Bench& bench) {
  return fmt::format("{} {}", placed.design.name, bench.family.device->option);
}

page::Row clock_row(const Placed& placed, const Bench& bench, const StoredClock& clock,
                    const Options& options) {
  const std::string& name = placed.design.name;
  const auto published = published_ns(name);
  const bool has_clock = clock.mhz > 0;
  page::Row row{.name = row_name(placed, bench),
                .section = placed.section,
                .fields = {{"design", quoted(placed.design)}},
                .details = name};
  const auto add = [&](std::string_view column, const std::string& text) {
    row.fields.emplace_back(column, text);
  };
  add("clock, MHz", has_clock ? fmt::format("{:.1f}", clock.mhz) : c_none);
  add("seeds, MHz", clock.range);
  add("ns per pixel", has_clock ? fmt::format("{:.1f}", 1000 / clock.mhz) : c_none);
  add("paper, ns", published ? std::to_string(*published) : c_none);
  add("critical path", clock.path);
  // The page has the cells of the listed designs on both devices in another section.
  if (!options.page || &bench.family == &c_ecp5)
    for (const CellColumn& column : bench.family.columns)
      add(column.title, std::to_string(clock.cells.*column.number));
  return row;
}

std::vector<page::Value> clock_values(std::span<const page::Row> rows) {
  std::vector<page::Value> values;
  for (const Sections& sections : c_sections)
    for (const page::Row& row : rows)
      if (row.section == sections.judged && row.field("clock, MHz") != c_none)
        values.push_back({sections.thresholds, row.details, {std::stod(row.field("clock, MHz"))}});
  return values;
}

std::string identity_of(const Design& design, const Options& options) {
  return netlist_identity(netlist_of(design, options.folders.cache));
}

std::vector<Placed> listed_hardware(const Options& options, const Sections& sections) {
  std::vector<Placed> hardware;
  Options all = options;
  if (options.page) all.part.clear();
  for (const ListedDesign& listed : selected(all))
    if (&sections.family == &c_ice40 ? listed.ice40 : listed.ecp5)
      hardware.push_back({listed.design, sections.judged, &sections.family == &c_ecp5 ? listed.seeds : 0});
    else if (&sections.family == &c_ecp5 && !options.page)
      hardware.push_back({listed.design, sections.others});
  return hardware;
}

// Add the hardware of the spaces whose netlist no listed design has.
void add_hardware_of_spaces(const Options& options, const Sections& sections, std::vector<Placed>& hardware) {
  const SimulatorFolders& folders = options.folders;
  std::set<std::string> netlists;
  for (const Placed& placed : hardware) netlists.insert(identity_of(placed.design, options));
  const std::filesystem::path spaces = folders.source / c_spaces;
  for (const auto& [space, scene] : c_studies) {
    auto points = study::read_space(spaces / space);
    // Pipelines of preset exact are much too large for the HX8K, and so are object processors.
    if (&sections.family == &c_ice40)
      std::erase_if(points, [](const study::DesignPoint& point) {
        return point.hardware.objects > 0 ||
               (point.preset == Preset::exact &&
                (point.method == study::Method::processors_1 || point.method == study::Method::processors_2));
      });
    const std::filesystem::path file = spaces / scene;
    for (Design& design : study::hardware_of_space(exists(file) ? file.string() : scene, points, folders))
      if (netlists.insert(identity_of(design, options)).second)
        hardware.push_back({std::move(design), sections.others});
  }
}

bool is_selected(const Placed& placed, const Options& options) {
  return placed.design.name.find(options.part) != std::string::npos;
}

// Without a stored clock, hardware that is not selected has no row.
Bench bench_of(const Options& options, const Sections& sections) {
  const Family& family = sections.family;
  Bench bench{.family = family,
              .synthesizer = Synthesizer::open(options.folders.cache, true, family),
              .hardware = listed_hardware(options, sections),
              .stored = must(read_clocks(options.folders.source, family))};
  if (options.page) add_hardware_of_spaces(options, sections, bench.hardware);
  std::erase_if(bench.hardware, [&](const Placed& placed) {
    return !is_selected(placed, options) && !bench.stored.contains(placed.design.name);
  });
  return bench;
}

// If the command line gives no number: that of the list, or of the stored clock.
unsigned seeds_of(const Options& options, const Placed& placed, const ClockStore& clocks) {
  if (options.seeds > 0 || placed.seeds > 0) return options.seeds > 0 ? options.seeds : placed.seeds;
  const auto stored = clocks.find(placed.design.name);
  return stored != clocks.end() && stored->second.seeds > 0 ? stored->second.seeds : c_seeds;
}

StoredClock placed_clock(const Placed& placed, const Bench& bench, unsigned seeds, const Options& options) {
  const Clock clock = bench.synthesizer.clock(placed.design, seeds);
  const Placement* median = clock.median();
  StoredClock result{.cells = bench.synthesizer.cells(placed.design, bench.family),
                     .seeds = static_cast<unsigned>(clock.placements.size()) + clock.endless,
                     .range = c_none,
                     .path = "not placed: " + clock.none,
                     .tools = bench.synthesizer.versions(),
                     .netlist = identity_of(placed.design, options),
                     .hardware = hardware_text(placed.design)};
  if (median == nullptr) return result;
  result.mhz = median->mhz;
  result.range =
      fmt::format("{:.0f} to {:.0f} of {}{}", clock.placements.front().mhz, clock.placements.back().mhz,
                  clock.placements.size(),
                  clock.endless > 0 ? fmt::format("; nextpnr does not end: {}", clock.endless) : "");
  result.path = path_text(median->path);
  return result;
}

// The stored clock if there is one, unless the flow has changed, or the products for multipliers (--again).
// Hardware that is not selected keeps its stored clock.
StoredClock clock_of(const Placed& placed, Bench& bench, const Options& options, std::mutex& mutex) {
  if (!options.page) return placed_clock(placed, bench, seeds_of(options, placed, bench.stored), options);
  const std::string netlist = identity_of(placed.design, options);
  unsigned seeds = 0;
  {
    const std::lock_guard lock(mutex);
    seeds = seeds_of(options, placed, bench.stored);
    const auto found = bench.stored.find(placed.design.name);
    const bool is_current =
        found != bench.stored.end() && is_placed(found->second, bench.synthesizer.versions(), netlist, seeds);
    if (is_current && !(options.again && is_selected(placed, options))) return found->second;
    if (!is_selected(placed, options)) {
      StoredClock old = found->second;
      old.path.insert(0, "of an earlier netlist or flow: ");
      return old;
    }
  }
  const StoredClock clock = placed_clock(placed, bench, seeds, options);
  const std::lock_guard lock(mutex);
  bench.stored[placed.design.name] = clock;
  must(write_clocks(options.folders.source, bench.family, bench.stored));
  return clock;
}

// Remove clocks of other hardware.
void finish(const Options& options, Bench& bench) {
  std::set<std::string> names;
  for (const Placed& placed : bench.hardware) names.insert(placed.design.name);
  std::erase_if(bench.stored, [&](const auto& clock) { return !names.contains(clock.first); });
  must(write_clocks(options.folders.source, bench.family, bench.stored));
}

}  // namespace

ExitCode clocks(const Options& options) {
  std::vector<Bench> benches;
  for (const Sections& sections : c_sections)
    if (options.page || options.device == sections.family.device->option)
      benches.push_back(bench_of(options, sections));
  std::mutex mutex;
  std::vector<Item> items;
  std::vector<std::string_view> tools = {"ghdl", "yosys"};
  for (Bench& bench : benches) {
    tools.push_back(bench.family.device->placer);
    for (const Placed& placed : bench.hardware)
      items.push_back({row_name(placed, bench), [&] {
                         return clock_row(placed, bench, clock_of(placed, bench, options, mutex), options);
                       }});
  }
  const ExitCode end = measure(options, {"clocks", std::move(tools), clock_values}, std::move(items));
  if (!options.page) return end;
  for (Bench& bench : benches) finish(options, bench);
  must(rewrite_page(options.folders.source / "docs/performance.md", [&](const std::string& page) {
    return with_page_part(page, "clocks", performance_table(benches.front().stored, benches.back().stored));
  }));
  return end;
}

}  // namespace halfway::synth

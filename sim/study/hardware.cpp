// SPDX-License-Identifier: Apache-2.0
#include "sim/study/hardware.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "plan/own_bells.hpp"
#include "sim/cost/netlist_identity.hpp"
#include "sim/engines/verilator/shader_netlist.hpp"
#include "sim/generator/word_lengths/made_tables.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/subprocess.hpp"
#include "sim/os/threads.hpp"
#include "sim/study/pictures.hpp"

namespace halfway::study {

namespace {

// The size of the point's tables if they are not compiled in.
std::optional<tables::CosineSize> made_size(const DesignPoint& point) {
  if (point.method != Method::spherical || !point.tables) return std::nullopt;
  if (!point.own_tables && tables::compiled_in(point.preset == Preset::exact, *point.tables))
    return std::nullopt;
  return point.tables;
}

std::vector<double> own_exponents_of(const DesignPoint& point, const Scene& scene) {
  return point.own_tables ? must(own_exponents(scene)) : std::vector<double>();
}

}  // namespace

PointHardware hardware_of(const DesignPoint& point, const Scene& scene) {
  PointHardware hardware;
  PlanRequest request = point.plan();
  request.own = own_exponents_of(point, scene);
  if (const auto size = made_size(point))
    hardware.tables = std::make_shared<tables::MadeTables>(point.preset == Preset::exact, *size, request.own);
  if (hardware.tables) request.made_tables = hardware.tables->tables();
  hardware.key = must(plan_scene(scene, request)).key;
  hardware.key.words = point.words;
  if (point.method == Method::processors_1 || point.method == Method::processors_2) {
    ProcessorUnits& units = hardware.key.processors;
    if (point.method == Method::processors_1 && units.positional + units.spots > 0)
      throw Failure{bad_input(scene.name +
                              ": version I of the processors has directional lights only; take version II")};
    units.normalize = point.method == Method::processors_2 && units.lights() > 0;
  }
  return hardware;
}

PointHardware drawing_hardware_of(const DesignPoint& point, const Scene& scene,
                                  const SimulatorFolders& folders) {
  PointHardware hardware = hardware_of(point, scene);
  if (point.words.any()) hardware.models = must(made_models(hardware.key, folders));
  return hardware;
}

SimulatorFolders rtl_of(const DesignPoint& point, const Scene& scene, const SimulatorFolders& folders) {
  const auto size = made_size(point);
  if (!size && !point.words.any()) return folders;
  return {must(tables::rtl_with(point.preset == Preset::exact, size, point.words, folders.source,
                                folders.cache, own_exponents_of(point, scene))),
          folders.cache};
}

synth::Design HardwareSource::design() const {
  const HardwareKey& key = hardware.key;
  return {.name = key.name(), .entity = key.entity(), .generics = key.generics()};
}

double cell_count(const Cells& cells) {
  constexpr double c_lut_bits = 16;
  return static_cast<double>(cells.luts + cells.flip_flops + cells.multiplier_luts) +
         static_cast<double>(cells.memory_bits) / c_lut_bits;
}

namespace {

struct Open {
  HardwareSource source;
  HardwareFigures* figures;
};

// Run `each` on all threads until one fails. Progress messages contain `what` and the number done.
void do_all(const std::vector<Open>& open, const FiguresOptions& options, const std::string& what,
            const std::function<void(const HardwareSource&, HardwareFigures&)>& each) {
  std::size_t done = 0;
  std::mutex mutex;
  if (!open.empty()) options.on_progress(fmt::format("{}: {}", what, open.size()));
  must_for_each(options.threads, open.size(), [&](std::size_t at) {
    each(open[at].source, *open[at].figures);
    const std::scoped_lock lock(mutex);
    options.on_progress(fmt::format("{}: {} of {}", what, ++done, open.size()));
  });
}

ClocksByNetlist stored_clocks(const SimulatorFolders& folders) {
  ClocksByNetlist clocks;
  for (const auto& [name, clock] : must(synth::read_clocks(folders.source)))
    clocks.try_emplace(clock.netlist, name, clock);
  return clocks;
}

void add_tools(HardwareFigures& figures, const std::string& tools) {
  if (!figures.tools.empty() && !tools.empty()) figures.tools += ", ";
  figures.tools += tools;
}

// Reason why stored hardware has no clock.
std::string no_placement(const synth::Ice40Cells& cells) {
  const std::string why = synth::does_not_fit(cells);
  return why.empty() ? "too full, or nextpnr does not end" : why;
}

void take_stored(const HardwareSource& source, const ClocksByNetlist& clocks, HardwareFigures& figures) {
  const auto found =
      clocks.find(synth::netlist_identity(must(netlist_of(source.hardware.key, source.folders))));
  if (found == clocks.end()) return;
  const synth::StoredClock& stored = found->second.second;
  figures.ice40 = stored.cells;
  if (stored.mhz > 0) {
    figures.mhz = stored.mhz;
    figures.clock = c_stored;
  } else {
    figures.clock = no_placement(stored.cells);
    figures.fits = false;
  }
  add_tools(figures, "placed with " + stored.tools);
}

// For hardware that does not fit: the slowest stored clock of the parts inside it.
void take_slowest_part(const HardwareSource& source, const ClocksByNetlist& clocks,
                       HardwareFigures& figures) {
  if (figures.fits) return;
  for (const std::string& part :
       synth::part_identities(must(netlist_of(source.hardware.key, source.folders)))) {
    const auto found = clocks.find(part);
    if (found == clocks.end()) continue;
    const auto& [name, stored] = found->second;
    if (stored.mhz <= 0 || (figures.part_mhz && *figures.part_mhz <= stored.mhz)) continue;
    figures.part_mhz = stored.mhz;
    figures.slowest_part = name;
  }
}

void count_cells(const HardwareSource& source, HardwareFigures& figures) {
  const CellCounter counter(source.folders);
  figures.cells = counter.count(source.hardware.key);
  add_tools(figures, "cells by " + counter.version());
}

// Yosys's generic synthesis already shows that some hardware is too large for the device, because every cell
// takes at least one logic cell. This avoids minutes and gigabytes of synthesis for the device.
void take_size(HardwareFigures& figures) {
  if (figures.mhz || !figures.fits || !figures.cells) return;
  std::string why = synth::does_not_fit("flip-flops", figures.cells->flip_flops, synth::c_device_cells);
  if (why.empty())
    why = synth::does_not_fit("LUTs of multipliers", figures.cells->multiplier_luts, synth::c_device_cells);
  if (why.empty()) return;
  figures.clock = std::move(why);
  figures.fits = false;
}

void place(const HardwareSource& source, HardwareFigures& figures) {
  if (figures.mhz || !figures.fits) return;
  const synth::Synthesizer synthesizer = synth::Synthesizer::open(source.folders, true);
  const synth::Clock clock = synthesizer.clock(source.design(), synth::c_seeds);
  figures.ice40 = synthesizer.ice40(source.design());
  add_tools(figures, "placed with " + synthesizer.versions());
  if (const synth::Placement* median = clock.median(); median != nullptr) {
    figures.mhz = median->mhz;
    figures.clock = "placed";
  } else {
    figures.clock = clock.none;
    figures.fits = clock.endless > 0;
  }
}

}  // namespace

std::vector<HardwareSource> hardware_of_space(const std::string& scene, std::span<const DesignPoint> points,
                                              const SimulatorFolders& folders) {
  std::vector<HardwareSource> sources;
  std::set<std::string> names;
  for (const DesignPoint& point : points) {
    if (!in_hardware(point.method)) continue;
    const Scene drawn = drawn_scene(scene, folders.source / "sim" / "scenes", point);
    auto hardware = caught([&] { return hardware_of(point, drawn); });
    if (!hardware || !names.insert(hardware->key.name()).second) continue;
    sources.push_back({std::move(*hardware), rtl_of(point, drawn, folders)});
  }
  return sources;
}

HardwareTable hardware_figures(const std::string& scene, std::span<const Record> records,
                               const SimulatorFolders& folders, const FiguresOptions& options) {
  HardwareTable table;
  std::vector<DesignPoint> points;
  for (const Record& record : records)
    if (in_hardware(record.point.method) && table.try_emplace(record.measured.hardware).second)
      points.push_back(record.point);
  std::vector<Open> open;
  for (HardwareSource& source : hardware_of_space(scene, points, folders)) {
    HardwareFigures& figures = table[source.hardware.key.name()];
    open.push_back({std::move(source), &figures});
  }
  const ClocksByNetlist clocks = stored_clocks(folders);
  do_all(open, options, "stored clocks", [&](const HardwareSource& source, HardwareFigures& figures) {
    take_stored(source, clocks, figures);
  });
  if (options.cells && !find_program("yosys").empty()) do_all(open, options, "cells", count_cells);
  for (const Open& each : open) take_size(*each.figures);
  if (options.place) do_all(open, options, "placements", place);
  do_all(open, options, "parts of hardware that does not fit",
         [&](const HardwareSource& source, HardwareFigures& figures) {
           take_slowest_part(source, clocks, figures);
         });
  return table;
}

HardwareFigures stored_figures(const HardwareSource& source, const SimulatorFolders& folders) {
  HardwareFigures figures;
  take_stored(source, stored_clocks(folders), figures);
  return figures;
}

Placements::Placements(const std::string& scene, std::span<const DesignPoint> points,
                       const SimulatorFolders& folders, const std::string& rtl)
    : hardware_(hardware_of_space(scene, points, folders)),
      stored_(stored_clocks(folders)),
      marks_(folders.cache / "placed") {
  ContentHash made_by;
  made_by.add("placed 2").add(rtl).add(synth::Synthesizer::open(folders, true).versions());
  for (const auto& [netlist, clock] : stored_) made_by.add(netlist);
  made_by_ = made_by.hex();
  must(make_folders(marks_));
}

std::string Placements::name(std::size_t number) const {
  return fmt::format("{}, seed {}", source_of(number).hardware.key.name(), seed_of(number));
}

std::filesystem::path Placements::mark(std::size_t number) const {
  return marks_ / ContentHash().add(made_by_).add(name(number)).hex();
}

bool Placements::is_done(std::size_t number) const {
  return std::filesystem::exists(mark(number));
}

void Placements::make(std::size_t number) const {
  const HardwareSource& source = source_of(number);
  HardwareFigures figures;
  take_stored(source, stored_, figures);
  count_cells(source, figures);
  take_size(figures);
  if (!figures.mhz && figures.fits) {
    const synth::Synthesizer synthesizer = synth::Synthesizer::open(source.folders, true);
    if (synthesizer.no_room(source.design()).empty()) synthesizer.place(source.design(), seed_of(number));
  }
  must(write_file(mark(number), ""));
}

}  // namespace halfway::study

// SPDX-License-Identifier: Apache-2.0
#include "sim/study/hardware.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "plan/own_bells.hpp"
#include "sim/formats/made_tables.hpp"
#include "sim/ghdl/hardware_units.hpp"
#include "sim/study/pictures.hpp"
#include "sim/synth/pinned.hpp"
#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"
#include "sim/system/threads.hpp"

namespace halfway::study {

namespace {

// The size of the point's tables if they are not compiled in.
std::optional<tables::CosineSize> made_size(const DesignPoint& point) {
  if (point.method != Method::spherical || !point.tables) return std::nullopt;
  const tables::CosineSize size{point.tables->address_bits, point.tables->data_bits};
  if (!point.own_tables && tables::compiled_in(point.preset == Preset::exact, size)) return std::nullopt;
  return size;
}

Result<std::vector<double>> own_exponents_of(const DesignPoint& point, const Scene& scene) {
  if (!point.own_tables) return std::vector<double>();
  return own_exponents(scene);
}

}  // namespace

Result<PointHardware> hardware_of(const DesignPoint& point, const Scene& scene) {
  PointHardware hardware;
  PlanRequest request = point.plan();
  auto own = own_exponents_of(point, scene);
  if (!own) return own.error();
  request.own = std::move(*own);
  if (const auto size = made_size(point))
    hardware.tables = std::make_shared<tables::MadeTables>(point.preset == Preset::exact, *size, request.own);
  if (hardware.tables) request.made_tables = hardware.tables->tables();
  auto plan = plan_scene(scene, request);
  if (!plan) return plan.error();
  hardware.key = plan->key;
  hardware.key.words = point.words;
  if (point.method == Method::processors_1 || point.method == Method::processors_2) {
    ProcessorUnits& units = hardware.key.processors;
    if (point.method == Method::processors_1 && units.positional + units.spots > 0)
      return bad_input(scene.name +
                       ": version I of the processors has directional lights only; take version II");
    units.normalize = point.method == Method::processors_2 && units.lights() > 0;
  }
  return hardware;
}

Result<PointHardware> drawing_hardware_of(const DesignPoint& point, const Scene& scene,
                                          const SimulatorFolders& folders) {
  auto hardware = hardware_of(point, scene);
  if (!hardware || !point.words.any()) return hardware;
  auto formats = MadeFormats::open(hardware->key, folders);
  if (!formats) return formats.error();
  hardware->formats = std::move(*formats);
  return hardware;
}

Result<SimulatorFolders> rtl_of(const DesignPoint& point, const Scene& scene,
                                const SimulatorFolders& folders) {
  const auto size = made_size(point);
  if (!size && !point.words.any()) return folders;
  const auto own = own_exponents_of(point, scene);
  if (!own) return own.error();
  const auto source =
      tables::rtl_with(point.preset == Preset::exact, size, point.words, folders.source, folders.cache, *own);
  if (!source) return source.error();
  return SimulatorFolders{*source, folders.cache};
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

Result<HardwareSource> source_of(const std::string& scene, const DesignPoint& point,
                                 const SimulatorFolders& folders) {
  const auto drawn = drawn_scene(scene, folders.source / "sim" / "scenes", point);
  if (!drawn) return drawn.error();
  auto hardware = hardware_of(point, *drawn);
  if (!hardware) return hardware.error();
  auto rtl = rtl_of(point, *drawn, folders);
  if (!rtl) return rtl.error();
  return HardwareSource{std::move(*hardware), std::move(*rtl)};
}

struct Open {
  HardwareSource source;
  HardwareFigures* figures;
};

// Run `each` for `count` items on all threads until one fails. Progress messages contain `what` and the
// number done.
Status do_all(std::size_t count, const FiguresOptions& options, const std::string& what,
              const std::function<Status(std::size_t)>& each) {
  std::size_t done = 0;
  std::mutex mutex;
  if (count > 0) options.on_progress(fmt::format("{}: {}", what, count));
  return for_each_on_threads(options.threads, count, [&](std::size_t at) -> Status {
    Status status = each(at);
    const std::scoped_lock lock(mutex);
    options.on_progress(fmt::format("{}: {} of {}", what, ++done, count));
    return status;
  });
}

Status add_pinned(const std::filesystem::path& file, PinnedClocks& clocks) {
  const auto pins = synth::read_pins(file);
  if (!pins) return pins.error();
  const auto tools = synth::pin_versions(file);
  if (!tools) return tools.error();
  for (const auto& [name, pin] : *pins)
    if (!pin.netlist.empty()) clocks.try_emplace(pin.netlist, PinnedClock{name, pin, *tools});
  return Ok{};
}

Result<PinnedClocks> pinned_clocks(const SimulatorFolders& folders) {
  PinnedClocks clocks;
  if (Status added = add_pinned(folders.source / synth::c_pins, clocks); !added) return added.error();
  const std::filesystem::path of_studies = folders.source / synth::c_study_pins;
  if (std::filesystem::exists(of_studies))
    if (Status added = add_pinned(of_studies, clocks); !added) return added.error();
  return clocks;
}

void add_tools(HardwareFigures& figures, const std::string& tools) {
  if (!figures.tools.empty() && !tools.empty()) figures.tools += ", ";
  figures.tools += tools;
}

// Reason why pinned hardware has no clock.
std::string no_placement(const synth::Ice40Cells& cells) {
  const std::string why = synth::does_not_fit(cells);
  return why.empty() ? "too full, or nextpnr does not end" : why;
}

// GHDL's library of the RTL, and the names of its entities.
struct Rtl {
  GhdlLibrary library;
  std::set<std::string> entities;
};
Result<Rtl> rtl_in(const SimulatorFolders& folders) {
  const auto tool = GhdlTool::find();
  if (!tool) return tool.error();
  const auto sources = read_rtl_sources(folders.source);
  if (!sources) return sources.error();
  auto library = GhdlLibrary::for_synthesis(*tool, *sources, folders.cache);
  if (!library) return library.error();
  return Rtl{std::move(*library), entities_of(*sources)};
}

Status take_pinned(const HardwareSource& source, const PinnedClocks& clocks, HardwareFigures& figures) {
  const auto rtl = rtl_in(source.folders);
  if (!rtl) return rtl.error();
  const auto hash = synth::netlist_hash(rtl->library, source.design());
  if (!hash) return hash.error();
  figures.netlist = *hash;
  const auto found = clocks.find(*hash);
  if (found == clocks.end()) return Ok{};
  const auto& [name, pin, tools] = found->second;
  figures.ice40 = pin.cells;
  if (pin.mhz > 0) {
    figures.mhz = pin.mhz;
    figures.clock = "pinned";
  } else {
    figures.clock = no_placement(pin.cells);
    figures.fits = false;
  }
  if (!tools.empty()) add_tools(figures, "pinned with " + tools);
  return Ok{};
}

// For hardware that does not fit: the slowest clock of the parts inside it that are pinned by themselves.
Status take_slowest_part(const HardwareSource& source, const PinnedClocks& clocks, HardwareFigures& figures) {
  const auto rtl = rtl_in(source.folders);
  if (!rtl) return rtl.error();
  const auto parts = synth::part_hashes(rtl->library, source.design(), rtl->entities);
  if (!parts) return parts.error();
  for (const std::string& part : *parts) {
    const auto found = clocks.find(part);
    if (found == clocks.end()) continue;
    const auto& [name, pin, tools] = found->second;
    if (pin.mhz <= 0 || (figures.part_mhz && *figures.part_mhz <= pin.mhz)) continue;
    figures.part_mhz = pin.mhz;
    figures.slowest_part = name;
  }
  return Ok{};
}

Status count_cells(const HardwareSource& source, HardwareFigures& figures) {
  const auto counter = CellCounter::open(source.folders);
  if (!counter) return counter.error();
  const auto cells = counter->count(source.hardware.key);
  if (!cells) return cells.error();
  figures.cells = *cells;
  add_tools(figures, "cells by " + counter->version().substr(0, counter->version().find('\n')));
  return Ok{};
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

// Return the synthesizer for placement, or std::nullopt if the clock or the reason for its absence is known.
Result<std::optional<synth::Synthesizer>> placer_of(const HardwareSource& source, HardwareFigures& figures) {
  if (figures.mhz || !figures.fits) return std::optional<synth::Synthesizer>();
  auto synthesizer = synth::Synthesizer::open(source.folders, true);
  if (!synthesizer) return synthesizer.error();
  const auto cells = synthesizer->ice40(source.design());
  if (!cells) return cells.error();
  figures.ice40 = *cells;
  add_tools(figures, "placed with " + synthesizer->versions());
  auto no_room = synthesizer->no_room(source.design());
  if (!no_room) return no_room.error();
  if (no_room->empty()) return std::optional(std::move(*synthesizer));
  figures.clock = std::move(*no_room);
  figures.fits = false;
  return std::optional<synth::Synthesizer>();
}

// Place each design with each seed as one list of jobs, so that all threads are busy to the end.
Status place_all(std::vector<Open>& open, const FiguresOptions& options) {
  struct Placed {
    Open* open;
    std::optional<synth::Synthesizer> placer{};
    std::vector<double> mhz{};
  };
  std::vector<Placed> placed;
  for (Open& each : open) placed.push_back({&each});
  Status packed = do_all(placed.size(), options, "logic cells", [&](std::size_t at) -> Status {
    auto placer = placer_of(placed[at].open->source, *placed[at].open->figures);
    if (!placer) return placer.error();
    placed[at].placer = std::move(*placer);
    return Ok{};
  });
  if (!packed) return packed;
  std::erase_if(placed, [](const Placed& each) { return !each.placer; });
  std::mutex mutex;
  Status routed =
      do_all(placed.size() * synth::c_seeds, options, "placements", [&](std::size_t job) -> Status {
        Placed& each = placed[job / synth::c_seeds];
        const auto placement =
            each.placer->place(each.open->source.design(), static_cast<unsigned>(1 + job % synth::c_seeds));
        if (!placement) return placement.error();
        if (!placement->ended) return Ok{};  // another seed may succeed
        const std::scoped_lock lock(mutex);
        each.mhz.push_back(placement->mhz);
        return Ok{};
      });
  if (!routed) return routed;
  for (Placed& each : placed) {
    HardwareFigures& figures = *each.open->figures;
    std::ranges::sort(each.mhz);
    if (each.mhz.empty()) {
      figures.clock = "not placed: nextpnr's router does not end";
    } else if (each.mhz.front() > 0) {
      figures.mhz = each.mhz[each.mhz.size() / 2];
      figures.clock = "placed";
    } else {
      figures.clock = "does not fit the HX8K";
      figures.fits = false;
    }
  }
  return Ok{};
}

}  // namespace

Result<HardwareTable> hardware_figures(const std::string& scene, std::span<const Record> records,
                                       const SimulatorFolders& folders, const FiguresOptions& options) {
  HardwareTable table;
  std::vector<Open> open;
  for (const Record& record : records) {
    if (!in_hardware(record.point.method)) continue;
    const auto [entry, is_new] = table.try_emplace(record.measured.hardware);
    if (!is_new) continue;
    auto source = source_of(scene, record.point, folders);
    if (!source) return source.error();
    open.push_back({std::move(*source), &entry->second});
  }
  const auto clocks = pinned_clocks(folders);
  if (!clocks) return clocks.error();
  const Status pinned = do_all(open.size(), options, "pinned clocks", [&](std::size_t at) {
    return take_pinned(open[at].source, *clocks, *open[at].figures);
  });
  if (!pinned) return pinned.error();
  if (options.cells && !find_program("yosys").empty()) {
    const Status counted = do_all(open.size(), options, "cells", [&](std::size_t at) {
      return count_cells(open[at].source, *open[at].figures);
    });
    if (!counted) return counted.error();
  }
  for (const Open& each : open) take_size(*each.figures);
  if (options.place)
    if (Status placed = place_all(open, options); !placed) return placed.error();
  std::vector<Open> too_large;
  std::ranges::copy_if(open, std::back_inserter(too_large),
                       [](const Open& each) { return !each.figures->fits; });
  const Status parts =
      do_all(too_large.size(), options, "parts of hardware that does not fit", [&](std::size_t at) {
        return take_slowest_part(too_large[at].source, *clocks, *too_large[at].figures);
      });
  if (!parts) return parts.error();
  return table;
}

Result<HardwareFigures> pinned_figures(const HardwareKey& key, const SimulatorFolders& folders) {
  const auto clocks = pinned_clocks(folders);
  if (!clocks) return clocks.error();
  HardwareFigures figures;
  if (Status taken = take_pinned({{.key = key}, folders}, *clocks, figures); !taken) return taken.error();
  return figures;
}

Result<std::size_t> pin_clocks(const HardwareTable& table, const SimulatorFolders& folders) {
  const std::filesystem::path file = folders.source / synth::c_study_pins;
  synth::Pins pins;
  if (std::filesystem::exists(file)) {
    auto there = synth::read_pins(file);
    if (!there) return there.error();
    pins = std::move(*there);
    std::erase_if(pins, [](const auto& entry) { return entry.second.netlist.empty(); });
  }
  PinnedClocks designs;
  if (Status added = add_pinned(folders.source / synth::c_pins, designs); !added) return added.error();
  for (const auto& [name, figures] : table) {
    pins.erase(name);
    if (figures.ice40 && !designs.contains(figures.netlist))
      pins[name] = {*figures.ice40, figures.mhz.value_or(0), figures.netlist};
  }
  const auto synthesizer = synth::Synthesizer::open(folders, true);
  if (!synthesizer) return synthesizer.error();
  if (Status written = synth::write_study_pins(file, pins, synthesizer->versions()); !written)
    return written.error();
  return pins.size();
}

Result<Placements> Placements::open(const std::string& scene, std::span<const DesignPoint> points,
                                    const SimulatorFolders& folders, const std::string& rtl) {
  Placements placements;
  for (const DesignPoint& point : points) {
    auto source = study::source_of(scene, point, folders);
    if (!source) return source.error();
    placements.hardware_.push_back(std::move(*source));
  }
  auto pinned = pinned_clocks(folders);
  if (!pinned) return pinned.error();
  const auto synthesizer = synth::Synthesizer::open(folders, true);
  if (!synthesizer) return synthesizer.error();
  ContentHash made_by;
  made_by.add("placed 1").add(synth::flow_hash()).add(rtl).add(synthesizer->versions());
  for (const auto& [netlist, clock] : *pinned) made_by.add(netlist);
  placements.pinned_ = std::move(*pinned);
  placements.made_by_ = made_by.hex();
  placements.marks_ = folders.cache / "placed";
  if (Status made = make_folders(placements.marks_); !made) return made.error();
  return placements;
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

Status Placements::make(std::size_t number) const {
  const HardwareSource& source = source_of(number);
  HardwareFigures figures;
  if (Status pinned = take_pinned(source, pinned_, figures); !pinned) return pinned;
  if (Status counted = count_cells(source, figures); !counted) return counted;
  take_size(figures);
  const auto placer = placer_of(source, figures);
  if (!placer) return placer.error();
  if (*placer)
    if (const auto placed = (*placer)->place(source.design(), seed_of(number)); !placed)
      return placed.error();
  return write_file(mark(number), "");
}

}  // namespace halfway::study

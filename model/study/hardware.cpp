// SPDX-License-Identifier: Apache-2.0
#include "study/hardware.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "common/subprocess.hpp"
#include "common/threads.hpp"
#include "sim/synth/pinned.hpp"
#include "study/pictures.hpp"
#include "tables/made_tables.hpp"

namespace halfway::study {

namespace {

// The size of the point's tables, if they have to be made.
std::optional<tables::CosineSize> made_size(const DesignPoint& point) {
  if (point.method != Method::spherical || !point.tables) return std::nullopt;
  const tables::CosineSize size{point.tables->address_bits, point.tables->data_bits};
  if (tables::compiled_in(point.preset == Preset::exact, size)) return std::nullopt;
  return size;
}

}  // namespace

Result<PointHardware> hardware_of(const DesignPoint& point, const Scene& scene) {
  PointHardware hardware;
  if (const auto size = made_size(point))
    hardware.tables = std::make_shared<tables::MadeTables>(point.preset == Preset::exact, *size);
  PlanRequest request = point.plan();
  request.made_tables = hardware.tables.get();
  auto plan = plan_scene(scene, request);
  if (!plan) return plan.error();
  hardware.key = plan->key;
  hardware.key.words = point.words;
  if (point.method == Method::processors_1 || point.method == Method::processors_2) {
    ProcessorUnits& units = hardware.key.processors;
    if (point.method == Method::processors_1 && units.positional + units.spots > 0)
      return bad_input(scene.name +
                       ": version I of the processors has no lights with a place; take version II");
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
  hardware->key.made_formats = hardware->formats.get();
  return hardware;
}

Result<SimulatorFolders> rtl_of(const DesignPoint& point, const SimulatorFolders& folders) {
  const auto size = made_size(point);
  if (!size && !point.words.any()) return folders;
  const auto source =
      tables::rtl_with(point.preset == Preset::exact, size, point.words, folders.source, folders.cache);
  if (!source) return source.error();
  return SimulatorFolders{*source, folders.cache};
}

double cell_count(const Cells& cells) {
  constexpr double c_lut_bits = 16;
  return static_cast<double>(cells.luts + cells.flip_flops + cells.multiplier_luts) +
         static_cast<double>(cells.memory_bits) / c_lut_bits;
}

namespace {

struct Open {
  PointHardware hardware;
  SimulatorFolders folders;
  HardwareFigures* figures;
  synth::Design design() const {
    const HardwareKey& key = hardware.key;
    return {.name = key.name(), .entity = key.entity(), .generics = key.generics()};
  }
};

// Each of `count` things on all threads, until one fails; `what` is said with how many are done.
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

// Clocks of netlists, by their hashes.
Result<std::map<std::string, double>> pinned_clocks(const SimulatorFolders& folders) {
  const auto pins = synth::read_pins(folders.source / synth::kPins);
  if (!pins) return pins.error();
  std::map<std::string, double> clocks;
  for (const auto& [name, pin] : *pins)
    if (!pin.netlist.empty() && pin.mhz > 0) clocks[pin.netlist] = pin.mhz;
  return clocks;
}

Status take_pinned(std::vector<Open>& open, const SimulatorFolders& folders, const FiguresOptions& options) {
  const auto clocks = pinned_clocks(folders);
  if (!clocks) return clocks.error();
  if (clocks->empty()) return Ok{};
  const auto tool = GhdlTool::find();
  if (!tool) return tool.error();
  return do_all(open.size(), options, "pinned clocks", [&](std::size_t at) -> Status {
    const auto sources = read_rtl_sources(open[at].folders.source);
    if (!sources) return sources.error();
    const auto library = GhdlLibrary::for_synthesis(*tool, *sources, open[at].folders.cache);
    if (!library) return library.error();
    const auto hash = synth::netlist_hash(*library, open[at].design());
    if (!hash) return hash.error();
    if (const auto found = clocks->find(*hash); found != clocks->end()) {
      open[at].figures->mhz = found->second;
      open[at].figures->clock = "pinned";
    }
    return Ok{};
  });
}

// Why cells that Yosys counted for no family cannot be on the device, where each takes a logic cell, too:
// told without synthesis for it, which is minutes and gigabytes of what is much too large.
std::string too_large(const std::optional<Cells>& cells) {
  if (!cells) return {};
  std::string why = synth::does_not_fit("flip-flops", cells->flip_flops, synth::kDeviceCells);
  if (why.empty())
    why = synth::does_not_fit("LUTs of multipliers", cells->multiplier_luts, synth::kDeviceCells);
  return why;
}

// Each seed of each design, so that all threads have work to the end.
Status place_all(std::vector<Open>& open, const FiguresOptions& options) {
  struct Placed {
    Open* open;
    synth::Synthesizer synthesizer;
    std::vector<double> mhz{};
  };
  std::vector<Placed> placed;
  for (Open& each : open) {
    HardwareFigures& figures = *each.figures;
    if (figures.mhz) continue;
    if (std::string reason = too_large(figures.cells); !reason.empty()) {
      figures.clock = std::move(reason);
      figures.fits = false;
      continue;
    }
    auto synthesizer = synth::Synthesizer::open(each.folders, true);
    if (!synthesizer) return synthesizer.error();
    placed.push_back({&each, std::move(*synthesizer)});
  }
  Status packed = do_all(placed.size(), options, "logic cells", [&](std::size_t at) -> Status {
    const auto& [each, synthesizer, mhz] = placed[at];
    HardwareFigures& figures = *each->figures;
    const auto cells = synthesizer.ice40(each->design());
    if (!cells) return cells.error();
    figures.ice40 = *cells;
    const auto no_room = synthesizer.no_room(each->design());
    if (!no_room) return no_room.error();
    if (!no_room->empty()) {
      figures.clock = *no_room;
      figures.fits = false;
    }
    return Ok{};
  });
  if (!packed) return packed;
  std::erase_if(placed, [](const Placed& each) { return !each.open->figures->fits; });
  std::mutex mutex;
  Status routed =
      do_all(placed.size() * synth::kSeeds, options, "placements", [&](std::size_t job) -> Status {
        Placed& each = placed[job / synth::kSeeds];
        const auto placement =
            each.synthesizer.place(each.open->design(), static_cast<unsigned>(1 + job % synth::kSeeds));
        if (!placement) return placement.error();
        if (!placement->ended) return Ok{};  // another seed's may
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
    const auto drawn = drawn_scene(scene, folders.source / "sim" / "scenes", record.point);
    if (!drawn) return drawn.error();
    auto hardware = hardware_of(record.point, *drawn);
    if (!hardware) return hardware.error();
    auto rtl = rtl_of(record.point, folders);
    if (!rtl) return rtl.error();
    open.push_back({std::move(*hardware), std::move(*rtl), &entry->second});
  }
  if (Status pinned = take_pinned(open, folders, options); !pinned) return pinned.error();
  if (!find_program("yosys").empty()) {
    const Status counted = do_all(open.size(), options, "cells", [&](std::size_t at) -> Status {
      const auto counter = CellCounter::open(open[at].folders);
      if (!counter) return counter.error();
      const auto cells = counter->count(open[at].hardware.key);
      if (!cells) return cells.error();
      open[at].figures->cells = *cells;
      return Ok{};
    });
    if (!counted) return counted.error();
  }
  if (options.place)
    if (Status placed = place_all(open, options); !placed) return placed.error();
  return table;
}

}  // namespace halfway::study

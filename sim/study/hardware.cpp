// SPDX-License-Identifier: Apache-2.0
#include "sim/study/hardware.hpp"

#include <mutex>
#include <set>

#include "plan/own_bells.hpp"
#include "sim/os/file.hpp"
#include "sim/os/threads.hpp"

namespace halfway::study {

namespace {

// The size of the point's tables if they are not compiled in.
std::optional<tables::CosineSize> made_size(const DesignPoint& point) {
  if (point.method != Method::spherical || !point.hardware.tables) return std::nullopt;
  if (!point.own_tables && tables::compiled_in(point.preset == Preset::exact, *point.hardware.tables))
    return std::nullopt;
  return point.hardware.tables;
}

std::vector<double> own_exponents_of(const DesignPoint& point, const Scene& scene) {
  return point.own_tables ? must(own_exponents(scene)) : std::vector<double>();
}

}  // namespace

PointHardware hardware_of(const DesignPoint& point, const Scene& scene) {
  if (point.filtered() && point.in_tiles())
    throw_bad_input("filtered frames are not drawn in tiles; give a larger tile");
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
      throw_bad_input("{}: version I of the processors has directional lights only; take version II",
                      scene.name);
    units.normalize = point.method == Method::processors_2 && units.lights() > 0;
  }
  return hardware;
}

PointHardware drawing_hardware_of(const DesignPoint& point, const Scene& scene,
                                  const SimulatorFolders& folders) {
  PointHardware hardware = hardware_of(point, scene);
  if (point.words.any()) hardware.models = made_models(hardware.key, folders);
  return hardware;
}

SimulatorFolders rtl_of(const DesignPoint& point, const Scene& scene, const SimulatorFolders& folders) {
  const auto size = made_size(point);
  if (!size && !point.words.any()) return folders;
  return {tables::rtl_with(point.preset == Preset::exact, size, point.words, folders.source, folders.cache,
                           own_exponents_of(point, scene)),
          folders.cache};
}

std::vector<synth::Design> hardware_of_space(const std::string& scene, std::span<const DesignPoint> points,
                                             const SimulatorFolders& folders) {
  std::vector<synth::Design> designs;
  std::set<std::string> names;
  for (const DesignPoint& point : points) {
    if (!in_hardware(point.method)) continue;
    const Scene drawn = drawn_scene(scene, folders.source / "sim" / "scenes", point);
    const auto hardware = caught([&] { return hardware_of(point, drawn); });
    if (hardware && names.insert(hardware->key.name()).second)
      designs.push_back(synth::design_of(hardware->key, rtl_of(point, drawn, folders).source));
  }
  return designs;
}

HardwareTable hardware_figures(const std::string& scene, std::span<const Record> records,
                               const SimulatorFolders& folders, const FiguresOptions& options) {
  HardwareTable table;
  std::vector<DesignPoint> points;
  for (const Record& record : records)
    if (in_hardware(record.point.method) && table.try_emplace(record.measured.hardware).second)
      points.push_back(record.point);
  const std::vector<synth::Design> designs = hardware_of_space(scene, points, folders);
  const synth::Costing costing(folders, *options.family);
  std::size_t done = 0;
  std::mutex mutex;
  must_for_each(options.threads, designs.size(), [&](std::size_t at) {
    synth::Cost cost = costing.of(designs[at], options.place);
    const std::scoped_lock lock(mutex);
    table[designs[at].name] = std::move(cost);
    options.on_progress(fmt::format("cost of hardware: {} of {}", ++done, designs.size()));
  });
  return table;
}

Placements::Placements(const std::string& scene, std::span<const DesignPoint> points,
                       const SimulatorFolders& folders, const std::string& rtl, const synth::Family& family)
    : hardware_(hardware_of_space(scene, points, folders)),
      costing_(folders, family),
      synthesizer_(synth::Synthesizer::open(folders.cache, true, family)),
      marks_(folders.cache / "placed") {
  ContentHash made_by;
  made_by.add("placed 2").add(rtl).add(synthesizer_.versions());
  for (const auto& [name, clock] : costing_.clocks()) made_by.add(clock.netlist);
  made_by_ = made_by.hex();
  must(make_folders(marks_));
}

std::string Placements::name(std::size_t number) const {
  return fmt::format("{}, seed {}", design_of(number).name, seed_of(number));
}

std::filesystem::path Placements::mark(std::size_t number) const {
  return marks_ / ContentHash().add(made_by_).add(name(number)).hex();
}

bool Placements::is_done(std::size_t number) const {
  return std::filesystem::exists(mark(number));
}

void Placements::make(std::size_t number) const {
  const synth::Design& design = design_of(number);
  const synth::Cost cost = costing_.of(design, false);
  if (!cost.mhz && cost.fits && synthesizer_.no_room(design).empty())
    synthesizer_.place(design, seed_of(number));
  must(write_file(mark(number), ""));
}

}  // namespace halfway::study

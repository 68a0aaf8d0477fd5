// SPDX-License-Identifier: Apache-2.0
#include "study/hardware.hpp"

#include <fmt/format.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "common/subprocess.hpp"
#include "common/threads.hpp"
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

Result<HardwareKey> hardware_of(const DesignPoint& point, const Scene& scene) {
  PlanRequest request = point.plan();
  if (const auto size = made_size(point))
    request.made_tables = std::make_shared<tables::MadeTables>(point.preset == Preset::exact, *size);
  auto plan = plan_scene(scene, request);
  if (!plan) return plan.error();
  HardwareKey key = plan->key;
  if (point.method == Method::processors_1 || point.method == Method::processors_2) {
    if (point.method == Method::processors_1 && key.processors.positional + key.processors.spots > 0)
      return bad_input(scene.name +
                       ": version I of the processors has no lights with a place; take version II");
    key.processors.normalize = point.method == Method::processors_2 && key.processors.lights() > 0;
  }
  return key;
}

Result<PointHardware> hardware_of(const DesignPoint& point, const Scene& scene,
                                  const SimulatorFolders& folders) {
  auto key = hardware_of(point, scene);
  if (!key) return key.error();
  PointHardware hardware{std::move(*key), folders};
  if (const auto size = made_size(point)) {
    const auto source =
        tables::rtl_with_tables(point.preset == Preset::exact, *size, folders.source, folders.cache);
    if (!source) return source.error();
    hardware.folders.source = *source;
  }
  return hardware;
}

double cell_count(const Cells& cells) {
  return static_cast<double>(cells.luts + cells.flip_flops + cells.product_bits);
}

Result<HardwareTable> hardware_figures(const std::string& scene, std::span<const Record> records,
                                       const SimulatorFolders& folders, unsigned threads,
                                       const std::function<void(const std::string&)>& on_progress) {
  HardwareTable table;
  std::vector<std::pair<PointHardware, HardwareFigures*>> open;
  for (const Record& record : records) {
    if (!in_hardware(record.point.method)) continue;
    const auto [entry, is_new] = table.try_emplace(record.measured.hardware);
    if (!is_new) continue;
    const auto drawn = drawn_scene(scene, folders.source / "sim" / "scenes", record.point);
    if (!drawn) return drawn.error();
    auto hardware = hardware_of(record.point, *drawn, folders);
    if (!hardware) return hardware.error();
    open.emplace_back(std::move(*hardware), &entry->second);
  }
  if (open.empty() || find_program("yosys").empty()) return table;
  std::atomic<std::size_t> next = 0, done = 0;
  std::mutex mutex;
  std::optional<Error> error;
  on_progress(fmt::format("cells of {} designs", open.size()));
  work_on_threads(threads, [&] {
    for (std::size_t at; (at = next++) < open.size();) {
      const auto& [hardware, figures] = open[at];
      const auto counter = CellCounter::open(hardware.folders);
      const auto cells = counter ? counter->count(hardware.key) : Result<Cells>(counter.error());
      const std::scoped_lock lock(mutex);
      if (cells)
        figures->cells = *cells;
      else if (!error)
        error = cells.error();
      on_progress(fmt::format("cells of {} of {} designs", ++done, open.size()));
    }
  });
  if (error) return *error;
  return table;
}

}  // namespace halfway::study

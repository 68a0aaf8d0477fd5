// SPDX-License-Identifier: Apache-2.0
// Table of all ways to draw a picture, compared with the project's own.
#include <fmt/format.h>

#include "sim/extras/bench/measurements.hpp"
#include "sim/extras/bench/ways.hpp"
#include "sim/os/threads.hpp"

namespace halfway {
namespace {

// A hardware to measure: a shader; the shading processors in both forms.
struct Hardware {
  const char* name;
  const char* heading;
  PlanRequest plan;
  bool lanes;
  FrameSize size, ghdl_size;  // smaller, because GHDL is slow
};
const Hardware c_hardware[] = {
    {"quadratic", "quadratic", {.shader = Shader::quadratic}, true, {1600, 1200}, {160, 120}},
    {"spherical", "spherical", {.shader = Shader::spherical}, true, {1600, 1200}, {160, 120}},
    {"processors", "processors, unrolled", {.shader = Shader::processors}, true, {800, 600}, {96, 72}},
    {"folded_processors",
     "folded",
     {.shader = Shader::processors, .form = ProcessorForm::folded},
     false,
     {320, 240},
     {64, 48}}};
constexpr std::size_t c_columns = std::size(c_hardware);

std::string name_of(Way way, std::size_t column) {
  return fmt::format("{}/{}/spheres", short_name(way), c_hardware[column].name);
}

// Software draws the same picture for all hardware. Folded processors are measured for their number of
// clocks.
bool is_measured(Way way, std::size_t column) {
  if (!lacking(way, c_folders).empty()) return false;
  if (way == Way::reference || way == Way::mesa) return column == 0;
  if (in_lanes(way)) return c_hardware[column].lanes;
  return true;
}

struct Column {
  Scene scene;
  GoldenStream stream, ghdl_stream;
  const GoldenStream& of(Way way) const { return way == Way::ghdl ? ghdl_stream : stream; }
};

// Build each way for each hardware and add its measurement.
void add_ways(const std::vector<Column>& columns, Measurements& measurements, unsigned jobs) {
  struct Job {
    Way way;
    std::size_t column;
    Go go{};
  };
  std::vector<Job> alone, compared;
  for (const Way way : c_ways)
    for (std::size_t column = 0; column < c_columns; ++column)
      if (is_measured(way, column)) (is_compared(way) ? compared : alone).push_back({way, column});
  // Ways with comparison use the hardware built for the ways without comparison.
  for (std::vector<Job>* jobs_now : {&alone, &compared}) {
    must_for_each(jobs, jobs_now->size(), [&](std::size_t i) {
      auto& [way, column, go] = (*jobs_now)[i];
      fmt::print(stderr, "building {}\n", name_of(way, column));
      const Hardware& hardware = c_hardware[column];
      go = make_way(way, {.scene = &columns[column].scene,
                          .size = way == Way::ghdl ? hardware.ghdl_size : hardware.size,
                          .stream = &columns[column].of(way),
                          .folders = c_folders,
                          .scratch = c_scratch});
    });
    for (Job& job : *jobs_now)
      measurements.add(name_of(job.way, job.column), job.way == Way::ghdl ? 2 : 11, std::move(job.go));
  }
}

Json mesa_note() {
  if (!lacking(Way::mesa, c_folders).empty()) return false;
  const Scene scene = builtin("spheres");
  const MesaRun picture = run_mesa({.scene = &scene,
                                    .size = c_hardware[0].size,
                                    .stream = nullptr,
                                    .folders = c_folders,
                                    .scratch = c_scratch},
                                   1);
  return {{"psnr", fmt::format("{:.1f}", picture.psnr_db)},
          {"max_lsb", picture.max_lsb},
          {"outline", fmt::format("{:.0f}", 1e6 * picture.outline_off)},
          {"renderer", picture.renderer}};
}

}  // namespace

void measure_ways(Json& speed, unsigned jobs) {
  std::vector<Column> columns;
  for (const Hardware& hardware : c_hardware) {
    const Scene scene = builtin("spheres");
    columns.push_back({scene, golden_stream(scene, hardware.size, hardware.plan),
                       golden_stream(scene, hardware.ghdl_size, hardware.plan)});
  }
  Measurements measurements;
  add_ways(columns, measurements, jobs);
  measurements.run();

  const auto nanoseconds = [&](Way way, std::size_t column) -> std::optional<double> {
    // Software has one picture for all columns.
    const std::size_t measured = way == Way::reference || way == Way::mesa ? 0 : column;
    const auto seconds = measurements.seconds(name_of(way, measured));
    if (!seconds) return std::nullopt;
    return 1e9 * *seconds / static_cast<double>(columns[measured].of(way).golden.size());
  };
  const auto cell = [&](Way way, std::size_t column) {
    const auto ours = nanoseconds(c_hardware[column].lanes ? Way::lanes_compared : Way::verilator_compared,
                                  column),
               taken = nanoseconds(way, column);
    if (taken && ours)
      return fmt::format("{} ({} {})", figure(*taken / *ours), figure(*taken < 1e4 ? *taken : 1e-3 * *taken),
                         *taken < 1e4 ? "ns" : "µs");
    const std::string lacks = lacking(way, c_folders);
    return lacks.empty() ? std::string("–") : lacks + " is not here";
  };
  Json hardware = Json::array(), rows = Json::array();
  for (const auto& [name, heading, plan, lanes, size, ghdl] : c_hardware)
    hardware.push_back(
        {{"heading", heading},
         {"frames", fmt::format("{}×{}; {}×{}", size.width, size.height, ghdl.width, ghdl.height)}});
  for (const Way way : c_ways) {
    Json row = {to_string(way)};
    for (std::size_t column = 0; column < c_columns; ++column) row.push_back(cell(way, column));
    rows.push_back(row);
  }
  speed["ways"] = {{"hardware", hardware}, {"rows", rows}, {"mesa", mesa_note()}};
}

}  // namespace halfway

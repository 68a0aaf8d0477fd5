// SPDX-License-Identifier: Apache-2.0
// Table of all ways to draw a picture, compared with the project's own.
#include <fmt/format.h>

#include "sim/bench/program/bench.hpp"
#include "sim/bench/ways.hpp"
#include "sim/system/threads.hpp"

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
constexpr std::size_t c_columns = std::size(c_hardware), c_folded = 3;

std::string name_of(Way way, std::size_t column) {
  return fmt::format("{}/{}/spheres", short_name(way), c_hardware[column].name);
}

bool in_ghdl(Way way) {
  return way == Way::ghdl_llvm || way == Way::ghdl_mcode;
}

// Software draws the same picture for all hardware. Folded processors are measured for their number of
// clocks.
bool is_measured(Way way, std::size_t column) {
  if (!is_wanted(name_of(way, column)) || !lacking(way, c_folders).empty()) return false;
  if (way == Way::reference || way == Way::mesa) return column == 0;
  if (in_lanes(way)) return c_hardware[column].lanes;
  if (way == Way::cxxrtl || way == Way::verilator_as_it_comes) return column != c_folded;
  return true;
}

Json mesa_note() {
  if (!lacking(Way::mesa, c_folders).empty()) return false;
  const Scene scene = builtin("spheres");
  const auto picture = run_mesa({.scene = &scene,
                                 .size = c_hardware[0].size,
                                 .batches = nullptr,
                                 .folders = c_folders,
                                 .scratch = c_scratch},
                                1);
  if (!picture) return false;
  return {{"psnr", fmt::format("{:.1f}", picture->psnr_db)},
          {"max_lsb", picture->max_lsb},
          {"outline", fmt::format("{:.0f}", 1e6 * picture->outline_off)},
          {"renderer", picture->renderer}};
}

}  // namespace

WayTable::WayTable(Measurements& measurements, unsigned jobs) : measurements_(measurements) {
  for (const Hardware& hardware : c_hardware) {
    Column column{builtin("spheres"), {}, {}};
    column.batches = must(make_batches(column.scene, hardware.size, hardware.plan));
    column.ghdl_batches = must(make_batches(column.scene, hardware.ghdl_size, hardware.plan));
    columns_.push_back(std::move(column));
  }
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
    must(for_each_on_threads(jobs, jobs_now->size(), [&](std::size_t i) -> Status {
      auto& [way, column, go] = (*jobs_now)[i];
      fmt::print(stderr, "building {}\n", name_of(way, column));
      const Column& of = columns_[column];
      auto made =
          make_way(way, {.scene = &of.scene,
                         .size = in_ghdl(way) ? c_hardware[column].ghdl_size : c_hardware[column].size,
                         .batches = in_ghdl(way) ? &of.ghdl_batches : &of.batches,
                         .folders = c_folders,
                         .scratch = c_scratch});
      if (!made) return made.error();
      go = std::move(*made);
      return Ok{};
    }));
    for (Job& job : *jobs_now)
      measurements.add(name_of(job.way, job.column), in_ghdl(job.way) ? 2 : 11, [go = std::move(job.go)] {
        return Measurements::Counters{{"seconds", must(go())}};
      });
  }
}

void WayTable::write(Json& speed) const {
  const auto nanoseconds = [&](Way way, std::size_t column) -> std::optional<double> {
    // Software has one picture for all columns.
    const std::size_t measured = way == Way::reference || way == Way::mesa ? 0 : column;
    const auto seconds = measurements_.seconds(name_of(way, measured));
    if (!seconds) return std::nullopt;
    const Column& of = columns_[measured];
    return 1e9 * *seconds / static_cast<double>((in_ghdl(way) ? of.ghdl_batches : of.batches).golden.size());
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
  speed["ways"] = {{"hardware", hardware}, {"rows", rows}};
  speed["mesa"] = mesa_note();
}

void WayTable::write_cores(Json& speed) const {
  for (std::size_t column = 0; column < c_columns; ++column)
    if (c_hardware[column].lanes && is_wanted(fmt::format("cores/{}", c_hardware[column].name)))
      measure_cores(c_hardware[column].name, columns_[column].batches, speed["cores"]);
}

}  // namespace halfway

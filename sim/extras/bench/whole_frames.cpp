// SPDX-License-Identifier: Apache-2.0
// A whole frame from the scene in memory to the picture in memory, by the project and by Mesa.
#include <fmt/format.h>

#include <thread>

#include "sim/extras/bench/measurements.hpp"
#include "sim/extras/bench/ways.hpp"
#include "sim/extras/lanes/lane_simulator.hpp"
#include "sim/os/threads.hpp"

namespace halfway {
namespace {

constexpr FrameSize c_size{1000, 1000};
constexpr const char* c_scene = "spheres";
constexpr int c_repetitions = 15, c_rate_repetitions = 5;
constexpr std::size_t c_rate_frames = 40;
constexpr unsigned c_cores = 2;

// Our way to the frame, with its measurements.
struct Path {
  const char* vectors;
  HardwareKey key;
  std::vector<WholeFrame> drawings{};  // one per core
  std::vector<FrameSeconds> costs{};
  std::vector<double> relative_to_mesa{}, rates{};
};

std::vector<Path> open_paths(const Scene& scene, unsigned cores) {
  std::vector<Path> paths;
  for (const Shader shader : {Shader::quadratic, Shader::spherical})
    for (const LaneVectors vectors : {LaneVectors::avx512, LaneVectors::avx2}) {
      Path path{vectors == LaneVectors::avx512 ? "this machine's" : "without AVX-512",
                must(plan_scene(scene, {.shader = shader})).key};
      fmt::print(stderr, "building {}, {}\n", path.key.name(), path.vectors);
      const auto engine = must(shared_engine(LaneSimulator::open(path.key, c_folders, {.vectors = vectors})));
      path.drawings.emplace_back(scene, c_size, path.key, engine);
      while (path.drawings.size() < cores)
        path.drawings.emplace_back(scene, c_size, path.key, must(engine->another()));
      path.drawings.front().draw();  // not timed
      paths.push_back(std::move(path));
    }
  return paths;
}

MesaRun draw_in_mesa(const Scene& scene, int repetitions) {
  return run_mesa(
      {.scene = &scene, .size = c_size, .stream = nullptr, .folders = c_folders, .scratch = c_scratch},
      repetitions);
}

// Frames per second of one Mesa per core, at the same time.
double mesa_rate(const Scene& scene, unsigned cores) {
  std::vector<double> rates(cores);
  must_for_each(cores, cores,
                [&](std::size_t i) { rates[i] = 1.0 / draw_in_mesa(scene, c_rate_frames).elapsed_seconds; });
  double sum = 0;
  for (const double rate : rates) sum += rate;
  return sum;
}

// The median of a part over the frames, in ms.
std::string median_ms(const std::vector<FrameSeconds>& costs, const auto& part) {
  std::vector<double> all;
  for (const FrameSeconds& cost : costs) all.push_back(1e3 * std::invoke(part, cost));
  return figure(median(all));
}

Json row_of(const Path& path, bool with_mesa, bool with_rates) {
  Json row = {to_string(path.key.shader), path.vectors};
  for (const auto part : {&FrameSeconds::setup, &FrameSeconds::golden, &FrameSeconds::rtl,
                          &FrameSeconds::compare, &FrameSeconds::assemble})
    row.push_back(median_ms(path.costs, part));
  row.push_back(median_ms(path.costs, &FrameSeconds::sum));
  row.push_back(with_mesa ? figure(median(path.relative_to_mesa)) : "–");
  row.push_back(with_rates ? figure(median(path.rates)) : "–");
  return row;
}

}  // namespace

// The frames of all paths and Mesa's are drawn in turn. A ratio is of two frames of the same turn.
void measure_whole_frames(Json& speed) {
  const Scene scene = builtin(c_scene);
  const unsigned cores = std::min(c_cores, std::thread::hardware_concurrency());
  const bool with_mesa = lacking(Way::mesa, c_folders).empty(), with_rates = cores == c_cores;
  std::vector<Path> paths = open_paths(scene, cores);
  std::vector<double> mesa_seconds, mesa_rates;
  std::string renderer;
  for (int repetition = 0; repetition < c_repetitions; ++repetition) {
    fmt::print(stderr, "whole frames: {} of {}\n", repetition + 1, c_repetitions);
    if (with_mesa) {
      const MesaRun run = draw_in_mesa(scene, 1);
      mesa_seconds.push_back(run.seconds);
      renderer = run.renderer;
    }
    for (Path& path : paths) {
      path.costs.push_back(path.drawings.front().draw());
      if (with_mesa) path.relative_to_mesa.push_back(path.costs.back().sum() / mesa_seconds.back());
    }
  }
  for (int repetition = 0; with_rates && repetition < c_rate_repetitions; ++repetition) {
    if (with_mesa) mesa_rates.push_back(mesa_rate(scene, cores));
    for (Path& path : paths) path.rates.push_back(frame_rate(path.drawings, c_rate_frames));
  }
  Json rows = Json::array();
  for (const Path& path : paths) rows.push_back(row_of(path, with_mesa, with_rates));
  if (with_mesa)
    rows.push_back({"Phong per pixel, Mesa", renderer, "–", "–", "–", "–", "–",
                    figure(1e3 * median(mesa_seconds)), "1",
                    mesa_rates.empty() ? "–" : figure(median(mesa_rates))});
  speed["whole_frames"] = {{"scene", c_scene},
                           {"width", c_size.width},
                           {"height", c_size.height},
                           {"repetitions", c_repetitions},
                           {"rows", rows}};
}

}  // namespace halfway

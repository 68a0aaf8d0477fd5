// SPDX-License-Identifier: Apache-2.0
// How time and memory grow with triangles, pixels and lights.
#include <fmt/format.h>

#include <algorithm>

#include "common/to_integer.hpp"
#include "sim/bench/program/bench.hpp"
#include "sim/run/open_engine.hpp"
#include "sim/system/threads.hpp"

namespace halfway {
namespace {

struct Point {
  std::string name;
  double n;
  FrameSize size;
  HardwareKey key;
  std::function<Scene()> scene;
  int repetitions;
};

/// The part of a frame's time to which a line is fitted.
enum class Fitted { all, drawing, nothing };

constexpr FrameSize c_growth_frame{1000, 1000};
constexpr unsigned c_frame_bytes = 3 + 4;  // of a pixel: colour, depth
constexpr double c_mebibyte = 1 << 20;

HardwareKey key_of(const Scene& scene, Shader shader) {
  return must(plan_scene(scene, {.shader = shader})).key;
}

// The parts of a frame's time, in the page's order.
constexpr std::pair<const char*, double FrameCost::*> c_parts[] = {{"setup", &FrameCost::setup},
                                                                   {"golden", &FrameCost::golden},
                                                                   {"rtl", &FrameCost::rtl},
                                                                   {"compare", &FrameCost::compare},
                                                                   {"assemble", &FrameCost::assemble}};
constexpr std::pair<const char*, std::uint64_t FrameCost::*> c_counts[] = {
    {"triangles", &FrameCost::triangles},
    {"vectors", &FrameCost::vectors},
    {"records", &FrameCost::records},
    {"fragments", &FrameCost::fragments},
    {"memory", &FrameCost::memory_bytes}};

Measurements::Counters counters_of(const FrameCost& cost) {
  Measurements::Counters counters = {
      {"seconds", cost.seconds()}, {"frame_pace", cost.pace}, {"best_frame_pace", cost.best_pace}};
  for (const auto& [name, part] : c_parts) counters[name] = cost.*part;
  for (const auto& [name, number] : c_counts) counters[name] = static_cast<double>(cost.*number);
  return counters;
}

// The mean of all repetitions, scaled to the pace of the run's best moment. The best repetition is not used:
// the largest frames take a minute, over which the machine's load averages out, but the smallest would find a
// millisecond without load.
FrameCost typical(const Measurements& measurements, const Point& point, double best_pace) {
  const auto value = [&](const char* statistic, const char* counter) {
    return measurements.statistic(point.name, statistic, counter).value();
  };
  FrameCost cost;
  for (const auto& [name, part] : c_parts)
    cost.*part = value("mean", name) / value("mean", "frame_pace") * best_pace;
  for (const auto& [name, number] : c_counts) cost.*number = to_integer<std::uint64_t>(value("median", name));
  return cost;
}

std::string deviation(const Fit& fit) {
  return fmt::format("{:.1f}", 100.0 * fit.largest_deviation);
}

}  // namespace

struct Growth::Series {
  std::string heading, unit, note;
  Fitted fitted;
  EngineKind engine = EngineKind::lanes;
  std::vector<Point> points{};

  Json data(const Measurements& measurements, double best_pace) const;
};

namespace {

// The fit with an additional term for lines.
Json lines_note(const std::vector<Point>& points, std::vector<Terms> rows, std::span<const double> t) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const InitBatches batches =
        must(make_batches(points[i].scene(), points[i].size, {.shader = points[i].key.shader}, false));
    rows[i].push_back(static_cast<double>(count_walk(batches).lines));
  }
  const Fit plane = fit(rows, t);
  if (rows.size() < 5 || plane.factors.empty()) return false;
  return {{"constant", fmt::format("{:.3g}", 1e3 * plane.factors[0])},
          {"pixel", fmt::format("{:.4g}", 1e9 * plane.factors[1])},
          {"line", fmt::format("{:.3g}", 1e9 * plane.factors[2])},
          {"deviation", deviation(plane)},
          {"frames", rows.size()}};
}

}  // namespace

Json Growth::Series::data(const Measurements& measurements, double best_pace) const {
  std::vector<Point> measured;
  std::ranges::copy_if(points, std::back_inserter(measured),
                       [&](const Point& point) { return measurements.has(point.name); });
  std::vector<FrameCost> costs;
  std::vector<double> t;
  std::vector<Terms> terms;
  for (const Point& point : measured) {
    costs.push_back(typical(measurements, point, best_pace));
    terms.push_back({1.0, point.n});
    t.push_back(fitted == Fitted::drawing ? costs.back().drawing() : costs.back().seconds());
  }
  Json data = {
      {"heading", heading},    {"unit", unit},    {"note", note},  {"measured", measured.size() >= 3},
      {"rows", Json::array()}, {"fitted", false}, {"lines", false}};
  if (measured.size() < 3) return data;
  const Fit line = fit(terms, t);
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const FrameCost& cost = costs[i];
    Json row = {count(unit == "triangles" ? cost.triangles : to_integer<std::uint64_t>(measured[i].n)),
                count(cost.vectors) + ", " + count(cost.records), count(cost.fragments)};
    for (const auto& [name, part] : c_parts) row.push_back(fmt::format("{:.4f}", cost.*part));
    row.push_back(fmt::format("{:.4f}", cost.seconds()));
    if (fitted != Fitted::nothing)
      row.push_back(fmt::format("{:+.1f} %", 100.0 * (t[i] / line.at(terms[i]) - 1.0)));
    const double frame =
        static_cast<double>(c_frame_bytes) * measured[i].size.width * measured[i].size.height;
    row.push_back(fmt::format("{:.1f} ({:.1f})", static_cast<double>(cost.memory_bytes) / c_mebibyte,
                              frame / c_mebibyte));
    data["rows"].push_back(row);
  }
  if (fitted == Fitted::nothing) return data;
  const bool slow = line.factors[1] >= 1e-4;
  data["fitted"] = {
      {"constant", fmt::format("{:.3g}", 1e3 * line.factors[0])},
      {"slope", fmt::format("{:.4g} {}", (slow ? 1e3 : 1e9) * line.factors[1], slow ? "ms" : "ns")},
      {"deviation", deviation(line)}};
  if (fitted == Fitted::drawing) data["lines"] = lines_note(measured, terms, t);
  return data;
}

Growth::~Growth() = default;

Growth::Growth(Measurements& measurements, unsigned jobs) : measurements_(measurements) {
  const auto by_triangles = [&](Series series, const char* name, Shader shader,
                                Scene (*make)(std::uint64_t)) {
    for (const std::uint64_t n : {1'000, 10'000, 100'000, 1'000'000, 10'000'000})
      series.points.push_back({fmt::format("{}/{}/{}", name, to_string(shader), n), static_cast<double>(n),
                               c_growth_frame, key_of(make(1'000), shader), [=] { return make(n); },
                               n >= 10'000'000  ? 2
                               : n >= 1'000'000 ? 4
                                                : 21});
    series_.push_back(std::move(series));
  };
  for (const Shader shader : {Shader::quadratic, Shader::spherical})
    by_triangles(
        {fmt::format("Triangles, {} shader", to_string(shader)), "triangles",
         "More and more spheres of 990 triangles in a frame of 1000×1000. The pixels per triangle do "
         "not change.",
         Fitted::all},
        "triangles", shader, many_spheres);
  by_triangles({"Finer triangles, quadratic shader", "triangles",
                "One sphere in a frame of 1000×1000, of smaller and smaller triangles. Its pixels are the "
                "constant part. No line\nfits: a triangle that covers no pixel gets no init vector and "
                "costs less, and from 10⁵ triangles on most cover none.",
                Fitted::nothing},
               "finer_triangles", Shader::quadratic, sphere_scene);
  for (const Shader shader : {Shader::quadratic, Shader::spherical}) {
    Series series{
        fmt::format("Pixels, {} shader", to_string(shader)), "pixels",
        shader == Shader::quadratic
            ? "A sphere of 990 triangles. Each visible triangle covers pixels, also in the smallest "
              "frame. The line fits the drawing only."
            : "The same sphere. The line fits the drawing only. Set-up depends on lines, whose number "
              "grows with the root of the pixels: it makes\none record per line, and searches "
              "some lines for their largest error. The drawing of a line costs as much as some pixels, which "
              "shows "
              "if lines are short.",
        Fitted::drawing};
    const Scene sphere = sphere_scene(1'000);
    for (const std::uint32_t side : {100U, 316U, 1000U, 2000U, 4000U})
      series.points.push_back({fmt::format("pixels/{}/{}", to_string(shader), side * side),
                               static_cast<double>(side) * side,
                               {side, side},
                               key_of(sphere, shader),
                               [=] { return sphere; },
                               side >= 4000   ? 7
                               : side >= 2000 ? 11
                                              : 31});
    series_.push_back(std::move(series));
  }
  for (const Shader shader : {Shader::spherical, Shader::processors}) {
    const bool lanes = shader == Shader::spherical;
    const FrameSize size = lanes ? FrameSize{800, 600} : FrameSize{320, 240};
    Series series{
        fmt::format("Lights, {}", lanes ? "spherical shader" : "shading processors"), "lights",
        fmt::format(
            "`spheres` at {}×{} under equal directional lights, with hardware for this number of lights.",
            size.width, size.height),
        Fitted::all, lanes ? EngineKind::lanes : EngineKind::verilator};
    for (const unsigned lights : {1U, 2U, 4U, 8U, 16U})
      series.points.push_back({fmt::format("lights/{}/{}", to_string(shader), lights),
                               static_cast<double>(lights), size,
                               key_of(with_lights(builtin("spheres"), lights), shader),
                               [=] { return with_lights(builtin("spheres"), lights); }, 11});
    series_.push_back(std::move(series));
  }

  // The largest hardware first: it takes longest to build.
  std::map<std::string, std::shared_ptr<Engine>> engines;
  std::vector<std::pair<HardwareKey, EngineKind>> keys;
  for (const Series& series : series_)
    for (const Point& point : series.points)
      if (is_wanted(point.name) && engines.try_emplace(point.key.name()).second)
        keys.emplace_back(point.key, series.engine);
  std::reverse(keys.begin(), keys.end());
  must(for_each_on_threads(jobs, keys.size(), [&](std::size_t i) -> Status {
    const auto& [key, kind] = keys[i];
    fmt::print(stderr, "building {}\n", key.name());
    auto engine = open_engine(kind, key, c_folders);
    if (!engine) return engine.error();
    engines.at(key.name()) = std::move(*engine);
    return Ok{};
  }));
  for (const Series& series : series_)
    for (const Point& point : series.points) {
      if (!is_wanted(point.name)) continue;
      measurements.add(point.name, point.repetitions,
                       [point, &pace = measurements.pace().work(), engine = engines.at(point.key.name())] {
                         const FrameCost cost =
                             must(draw_frame(point.scene, point.size, point.key, engine, pace));
                         if (cost.mismatches != 0)
                           throw Failure{{ExitCode::differs, point.name + ": the RTL differs"}};
                         return counters_of(cost);
                       });
    }
}

void Growth::write(Json& speed) const {
  double best_pace = std::numeric_limits<double>::infinity();
  for (const Series& series : series_)
    for (const Point& point : series.points)
      if (const auto pace = measurements_.statistic(point.name, "best", "best_frame_pace"))
        best_pace = std::min(best_pace, *pace);
  speed["frame_bytes"] = c_frame_bytes;
  speed["growth"] = Json::array();
  for (const Series& series : series_) speed["growth"].push_back(series.data(measurements_, best_pace));
}

}  // namespace halfway

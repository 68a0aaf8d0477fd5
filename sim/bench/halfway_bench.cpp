// SPDX-License-Identifier: Apache-2.0
// halfway_bench [--page FILE [--readme FILE]] [--jobs N] [--benchmark_…]: speed, as ratios within one run.
// Every way to a picture beside the project's own; how time and memory grow with triangles, pixels and
// lights; small triangles; cores; `make sim` as a whole. --page: writes the tables. Figures are processor
// time, the median of several repetitions in random order, at the pace of the best moment; absolute ones
// belong to the machine that prints them.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <regex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "golden_run/golden_run.hpp"
#include "sim/bench/readme_parts.hpp"
#include "sim/bench/ways.hpp"
#include "sim/bench/workload.hpp"
#include "sim/bench/yardstick.hpp"
#include "sim/compare/stream_comparator.hpp"
#include "sim/lanes/lane_simulator.hpp"
#include "sim/scene_files/load_scene.hpp"
#include "sim/system/file.hpp"
#include "sim/system/machine.hpp"
#include "sim/system/page_part.hpp"
#include "sim/system/seconds.hpp"
#include "sim/system/subprocess.hpp"
#include "sim/system/threads.hpp"
#include "sim/verilator/verilator_simulator.hpp"

namespace halfway {
namespace {

const std::filesystem::path c_source = HALFWAY_SOURCE_DIR;
const SimulatorFolders c_folders{c_source, c_source / "build" / "cache"};
const std::filesystem::path c_scratch = c_source / "build" / "bench";

[[noreturn]] void fail(const Error& error) {
  fmt::print(stderr, "{}\n", error.message);
  std::exit(static_cast<int>(error.code));
}

template <class T>
T must(Result<T> result) {
  if (!result) fail(result.error());
  return std::move(*result);
}

void must(const Status& status) {
  if (!status) fail(status.error());
}

Scene builtin(const char* name) {
  return must(load_scene(name, c_source / "sim" / "scenes"));
}

// What is measured: a shader, the shading processors in either form.
struct Hardware {
  const char* name;
  const char* heading;
  PlanRequest plan;
  bool lanes;
  FrameSize size, ghdl_size;  // GHDL takes its time
};
const Hardware c_hardware[] = {
    {"quadratic", "quadratic", {.shader = Shader::quadratic}, true, {1600, 1200}, {160, 120}},
    {"spherical", "spherical", {.shader = Shader::spherical}, true, {1600, 1200}, {160, 120}},
    {"processors", "processors, unrolled", {.shader = Shader::processors}, false, {800, 600}, {96, 72}},
    {"folded_processors",
     "folded",
     {.shader = Shader::processors, .form = ProcessorForm::folded},
     false,
     {320, 240},
     {64, 48}}};
constexpr std::size_t c_columns = std::size(c_hardware);

/// Of at least one.
double median(std::vector<double> all) {
  std::ranges::sort(all);
  const std::size_t half = all.size() / 2;
  return all.size() % 2 != 0 ? all[half] : 0.5 * (all[half - 1] + all[half]);
}

/// Whether --benchmark_filter lets it through.
bool is_wanted(const std::string& name) {
  const std::string filter = benchmark::GetBenchmarkFilter();
  if (filter.empty() || filter == "all") return true;
  return filter.front() == '-' ? !std::regex_search(name, std::regex(filter.substr(1)))
                               : std::regex_search(name, std::regex(filter));
}

/// The same piece of work, again and again: how quick this core of a shared machine is just now.
class Pace {
 public:
  Pace()
      : work_(must(make_batches(builtin("spheres"), {560, 420}, {.shader = Shader::quadratic}))),
        golden_(make_golden_model(work_.key)) {}
  const InitBatches& work() const { return work_; }
  /// Processor seconds.
  double take() {
    constexpr int c_times = 4;
    const double start = process_seconds();
    for (int i = 0; i < c_times; ++i) {
      fragments_.clear();
      golden_->draw(work_.words, fragments_);
    }
    return (process_seconds() - start) / c_times;
  }

 private:
  InitBatches work_;
  std::unique_ptr<GoldenModel> golden_;
  std::vector<Fragment> fragments_;
};

/// Registered with Google Benchmark, which repeats them in random order.
class Measurements {
 public:
  void add(const std::string& name, int repetitions, Go go) {
    std::vector<Timed>& timed = timed_[name];
    const auto measure = [this, &timed, name, go = std::move(go)](benchmark::State& state) {
      for (auto _ : state) {
        const double before = pace_.take();
        const auto seconds = go();
        if (!seconds) {
          failed_ = seconds.error();
          state.SkipWithError(seconds.error().message.c_str());
          return;
        }
        const double after = pace_.take();
        best_pace_ = std::min({best_pace_, before, after});
        timed.push_back({*seconds, 0.5 * (before + after)});
        state.SetIterationTime(*seconds);
        fmt::print(stderr, "{}: {:.4g} s\n", name, *seconds);
      }
    };
    benchmark::RegisterBenchmark(name.c_str(), measure)
        ->UseManualTime()
        ->Iterations(1)
        ->Repetitions(repetitions)
        ->ComputeStatistics("best", [](const std::vector<double>& all) { return std::ranges::min(all); })
        ->DisplayAggregatesOnly()
        ->Unit(benchmark::kMillisecond);
  }
  /// The median of all repetitions, each at the pace of the best moment; none where it was not measured.
  std::optional<double> seconds(const std::string& name) const {
    const auto found = timed_.find(name);
    if (found == timed_.end() || found->second.empty()) return std::nullopt;
    std::vector<double> all;
    for (const Timed& timed : found->second) all.push_back(timed.seconds / timed.pace * best_pace_);
    return median(std::move(all));
  }
  const std::optional<Error>& failed() const { return failed_; }
  const Pace& pace() const { return pace_; }

 private:
  struct Timed {
    double seconds, pace;
  };
  Pace pace_;
  double best_pace_ = std::numeric_limits<double>::infinity();
  std::map<std::string, std::vector<Timed>> timed_;
  std::optional<Error> failed_;
};

// --- Ratios

struct WayTable {
  struct Column {
    Scene scene;
    InitBatches batches, ghdl_batches;
  };
  std::vector<Column> columns;

  static std::string name(Way way, std::size_t column) {
    return fmt::format("{}/{}/spheres", short_name(way), c_hardware[column].name);
  }
  static bool in_ghdl(Way way) { return way == Way::ghdl_llvm || way == Way::ghdl_mcode; }
  const InitBatches& batches(Way way, std::size_t column) const {
    return in_ghdl(way) ? columns[column].ghdl_batches : columns[column].batches;
  }
  /// Software knows one picture, whatever the hardware; folded processors are there for their clocks.
  static bool is_measured(Way way, std::size_t column) {
    if (!is_wanted(name(way, column)) || !lacking(way, c_folders).empty()) return false;
    if (way == Way::reference || way == Way::mesa) return column == 0;
    if (way == Way::lanes || way == Way::lanes_compared) return c_hardware[column].lanes;
    if (way == Way::cxxrtl || way == Way::verilator_as_it_comes) return column < 3;
    return true;
  }
};

WayTable make_ways(Measurements& measurements, unsigned jobs) {
  WayTable table;
  for (const Hardware& hardware : c_hardware) {
    WayTable::Column column{builtin("spheres"), {}, {}};
    column.batches = must(make_batches(column.scene, hardware.size, hardware.plan));
    column.ghdl_batches = must(make_batches(column.scene, hardware.ghdl_size, hardware.plan));
    table.columns.push_back(std::move(column));
  }
  struct Job {
    Way way;
    std::size_t column;
    Go go{};
  };
  std::vector<Job> work, with_comparison;
  for (const Way way : c_ways)
    for (std::size_t column = 0; column < c_columns; ++column)
      if (WayTable::is_measured(way, column))
        (way == Way::lanes_compared || way == Way::verilator_compared ? with_comparison : work)
            .push_back({way, column});
  // What is compared is built already, by the same hardware alone.
  for (std::vector<Job>* jobs_now : {&work, &with_comparison}) {
    must(for_each_on_threads(jobs, jobs_now->size(), [&](std::size_t i) -> Status {
      Job& job = (*jobs_now)[i];
      fmt::print(stderr, "building {}\n", WayTable::name(job.way, job.column));
      const auto& hardware = c_hardware[job.column];
      auto go = make_way(job.way, {.scene = &table.columns[job.column].scene,
                                   .size = WayTable::in_ghdl(job.way) ? hardware.ghdl_size : hardware.size,
                                   .batches = &table.batches(job.way, job.column),
                                   .folders = c_folders,
                                   .scratch = c_scratch});
      if (!go) return go.error();
      job.go = std::move(*go);
      return Ok{};
    }));
    for (Job& job : *jobs_now)
      measurements.add(WayTable::name(job.way, job.column), WayTable::in_ghdl(job.way) ? 2 : 11,
                       std::move(job.go));
  }
  return table;
}

// --- Growth

struct Point {
  std::string name;
  double n;
  FrameSize size;
  HardwareKey key;
  std::function<Scene()> scene;
  int wanted;  ///< repetitions
  std::vector<FrameCost> repetitions{};
};

/// The mean of all repetitions, at the pace of the run's best moment. Not the best of all: the largest frames
/// take a minute, over which the load of the machine evens out, and the smallest would find a quiet
/// millisecond.
FrameCost typical(const Point& point, double best_pace) {
  FrameCost cost = point.repetitions.front();
  double paces = 0.0;
  for (const FrameCost& repetition : point.repetitions) paces += repetition.pace;
  for (double FrameCost::*part :
       {&FrameCost::setup, &FrameCost::golden, &FrameCost::rtl, &FrameCost::compare, &FrameCost::assemble}) {
    double seconds = 0.0;
    for (const FrameCost& repetition : point.repetitions) seconds += repetition.*part;
    cost.*part = seconds / paces * best_pace;
  }
  return cost;
}

/// What of a frame's time is held against a line.
enum class Fitted { all, drawing, nothing };

struct Series {
  std::string heading, unit, note;
  Fitted fitted;
  bool lanes = true;
  std::vector<Point> points{};
};

constexpr FrameSize c_growth_frame{1000, 1000};
constexpr unsigned c_frame_bytes = 3 + 4;  // of a pixel: colour, depth

HardwareKey key_of(const Scene& scene, Shader shader) {
  return must(plan_scene(scene, {.shader = shader})).key;
}

std::vector<Series> growth_series() {
  std::vector<Series> all;
  const auto by_triangles = [&](Series series, const char* name, Shader shader,
                                Scene (*make)(std::uint64_t)) {
    for (const std::uint64_t n : {1'000, 10'000, 100'000, 1'000'000, 10'000'000})
      series.points.push_back({fmt::format("{}/{}/{}", name, to_string(shader), n), static_cast<double>(n),
                               c_growth_frame, key_of(make(1'000), shader), [=] { return make(n); },
                               n >= 10'000'000  ? 2
                               : n >= 1'000'000 ? 4
                                                : 21});
    all.push_back(std::move(series));
  };
  for (const Shader shader : {Shader::quadratic, Shader::spherical})
    by_triangles({fmt::format("Triangles, {} shader", to_string(shader)), "triangles",
                  "More and more spheres of 990 triangles in a frame of 1000×1000, beside and behind one "
                  "another: each "
                  "triangle has as many pixels.",
                  Fitted::all},
                 "triangles", shader, many_spheres);
  by_triangles({"Finer triangles, quadratic shader", "triangles",
                "One sphere in a frame of 1000×1000, cut finer and finer. Its pixels are the constant part. "
                "The line is "
                "no line: a triangle that covers no\npixel gets no init vector and costs less, and from 10⁵ "
                "on most are "
                "such.",
                Fitted::nothing},
               "finer_triangles", Shader::quadratic, sphere_scene);
  for (const Shader shader : {Shader::quadratic, Shader::spherical}) {
    Series series{
        fmt::format("Pixels, {} shader", to_string(shader)), "pixels",
        shader == Shader::quadratic
            ? "A sphere of 990 triangles, of which every one in sight covers pixels in the smallest frame, "
              "too. The line is that of the drawing."
            : "The same sphere. The line is that of the drawing; setup depends on lines, which grow with "
              "the root of the pixels: a record each, for\nwhich it looks at every pixel of short ones. A "
              "line costs the drawing as much as some pixels, too: it tells where lines are short.",
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
    all.push_back(std::move(series));
  }
  for (const Shader shader : {Shader::spherical, Shader::processors}) {
    const bool lanes = shader == Shader::spherical;
    const FrameSize size = lanes ? FrameSize{800, 600} : FrameSize{320, 240};
    Series series{fmt::format("Lights, {}", lanes ? "spherical shader" : "shading processors"), "lights",
                  fmt::format("`spheres` at {}×{} under equal directional lights, hardware for as many.",
                              size.width, size.height),
                  Fitted::all, lanes};
    for (const unsigned lights : {1U, 2U, 4U, 8U, 16U})
      series.points.push_back({fmt::format("lights/{}/{}", to_string(shader), lights),
                               static_cast<double>(lights), size,
                               key_of(with_lights(builtin("spheres"), lights), shader),
                               [=] { return with_lights(builtin("spheres"), lights); }, 11});
    all.push_back(std::move(series));
  }
  return all;
}

void add_growth(Measurements& measurements, std::vector<Series>& all, unsigned jobs) {
  struct Job {
    Point* point;
    bool lanes;
  };
  std::vector<Job> work;
  for (Series& series : all)
    for (Point& point : series.points)
      if (is_wanted(point.name)) work.push_back({&point, series.lanes});
  // The largest first: they take longest to build.
  std::map<std::string, std::shared_ptr<RtlModel>> models;
  std::vector<std::pair<HardwareKey, bool>> keys;
  for (const Job& job : work)
    if (models.try_emplace(job.point->key.name()).second) keys.emplace_back(job.point->key, job.lanes);
  std::reverse(keys.begin(), keys.end());
  must(for_each_on_threads(jobs, keys.size(), [&](std::size_t i) -> Status {
    const auto& [key, lanes] = keys[i];
    fmt::print(stderr, "building {}\n", key.name());
    auto model = RtlModel::open(key, c_folders, lanes);
    if (!model) return model.error();
    models.at(key.name()) = std::make_shared<RtlModel>(std::move(*model));
    return Ok{};
  }));
  for (const Job& job : work) {
    Point& point = *job.point;
    measurements.add(
        point.name, point.wanted,
        [&point, &pace = measurements.pace().work(), rtl = models.at(point.key.name())]() -> Result<double> {
          const auto cost = draw_frame(point.scene, point.size, point.key, *rtl, pace);
          if (!cost) return cost.error();
          if (cost->mismatches != 0) return Error{ExitCode::differs, point.name + ": the RTL differs"};
          point.repetitions.push_back(*cost);
          return cost->seconds();
        });
  }
}

// --- Small triangles: clocks, no time

struct SmallRow {
  std::uint64_t triangles;
  Shader shader;
  std::uint64_t cycles, records;
  WalkCounts walk;
};

std::vector<SmallRow> small_triangles() {
  constexpr FrameSize c_frame{500, 500};
  std::vector<std::pair<double, Scene>> scenes;
  for (const double wanted : {1.25, 3.0, 10.0, 30.0, 100.0}) {
    // Triangles that cover a pixel have so many.
    double triangles = 1e5;
    for (int i = 0; i < 4; ++i) {
      const InitBatches all = must(make_batches(sphere_scene(static_cast<std::uint64_t>(triangles)), c_frame,
                                                {.shader = Shader::processors}));
      triangles *=
          static_cast<double>(all.golden.size()) / static_cast<double>(count_walk(all).headers) / wanted;
      triangles = std::clamp(triangles, 100.0, 1e7);
    }
    scenes.emplace_back(wanted, sphere_scene(static_cast<std::uint64_t>(triangles)));
  }
  std::vector<SmallRow> rows;
  for (const Shader shader : {Shader::quadratic, Shader::spherical, Shader::processors})
    for (const auto& [wanted, scene] : scenes) {
      const InitBatches all = must(make_batches(scene, c_frame, {.shader = shader}));
      auto rtl = must(RtlModel::open(all.key, c_folders, false));
      std::vector<Fragment> drawn;
      must(rtl.draw(all.words, true, drawn));
      if (drawn != all.golden) fail({ExitCode::differs, "small triangles: the RTL differs"});
      const WalkCounts walk = count_walk(all);
      rows.push_back({scene.triangles.size(), shader, rtl.cycles(),
                      shader == Shader::spherical ? all.vectors() - walk.headers : 0, walk});
      fmt::print(stderr, "small triangles: {}, {} pixels each: {:.3f} clocks a fragment\n", to_string(shader),
                 wanted, static_cast<double>(rtl.cycles()) / static_cast<double>(walk.pixels));
    }
  return rows;
}

// --- Cores

struct CoreRow {
  unsigned threads;
  double speed, processor;  ///< as fast by the clock, and processor time of all threads, as one thread
  double yardstick;         ///< as fast, in registers alone
  double beside;            ///< ours by the yardstick's
};

/// Times of work that threads share, one of its pieces after the other.
struct Shared {
  double seconds, processor;  ///< by the clock, and of all threads
};
Shared share(unsigned threads, std::size_t pieces, const std::function<void(unsigned, std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::atomic<unsigned> thread = 0;
  const double processor_start = process_seconds();
  const auto start = std::chrono::steady_clock::now();
  work_on_threads(threads, [&] {
    const unsigned own = thread++;
    for (std::size_t i; (i = next++) < pieces;) work(own, i);
  });
  return {seconds_since(start), process_seconds() - processor_start};
}

/// Golden model, lanes and comparison of fifths of frames that the threads take by turns, and after each the
/// yardstick on as many threads.
std::vector<CoreRow> measure_cores(const InitBatches& s, unsigned most) {
  constexpr std::size_t c_parts = 5, c_frames = 12;
  constexpr int c_repetitions = 15;
  constexpr std::uint32_t c_yardstick_rounds = 1'000'000;  // about as long as a fifth of a frame
  std::vector<std::span<const std::uint32_t>> parts;
  const std::size_t each = (s.batches.size() + c_parts - 1) / c_parts;
  for (std::size_t at = 0, i = 0; i < s.batches.size();) {
    std::size_t vectors = 0;
    for (const std::size_t end = std::min(i + each, s.batches.size()); i < end; ++i) vectors += s.batches[i];
    parts.push_back(std::span(s.words).subspan(at * s.words_per_vector(), vectors * s.words_per_vector()));
    at += vectors;
  }
  std::vector<RtlModel> models;
  std::vector<std::unique_ptr<GoldenModel>> goldens;
  for (unsigned i = 0; i < most; ++i) {
    models.push_back(must(RtlModel::open(s.key, c_folders, true)));
    goldens.push_back(make_golden_model(s.key));
  }
  // A core is now quicker, now slower: one thread is held against several right after it, and not the best of
  // its times, on the best of all cores, against moments in which all were quick together.
  std::vector<std::vector<double>> speeds(most), processors(most), yardsticks(most), besides(most);
  const std::size_t pieces = c_frames * parts.size();
  for (int repetition = 0; repetition < c_repetitions; ++repetition) {
    Shared one{}, yard{};
    for (unsigned threads = 1; threads <= most; ++threads) {
      std::atomic<std::uint64_t> mismatches = 0, fragments = 0;
      const Shared took = share(threads, pieces, [&](unsigned own, std::size_t piece) {
        StreamComparator comparator;
        std::uint64_t drawn_here = 0;
        must(models[own].draw(parts[piece % parts.size()], true, [&](auto words, auto drawn) {
          comparator.add(goldens[own]->draw(words), drawn);
          drawn_here += drawn.size();
        }));
        comparator.finish();
        mismatches += comparator.mismatches();
        fragments += drawn_here;
      });
      if (mismatches != 0 || fragments != c_frames * s.golden.size())
        fail({ExitCode::differs, "cores: the RTL differs"});
      const Shared took_yard = share(threads, pieces, [](unsigned, std::size_t) {
        benchmark::DoNotOptimize(sum_in_registers(c_yardstick_rounds));
      });
      if (threads == 1) {
        one = took;
        yard = took_yard;
      }
      speeds[threads - 1].push_back(one.seconds / took.seconds);
      processors[threads - 1].push_back(took.processor / one.processor);
      yardsticks[threads - 1].push_back(yard.seconds / took_yard.seconds);
      besides[threads - 1].push_back(speeds[threads - 1].back() / yardsticks[threads - 1].back());
    }
  }
  std::vector<CoreRow> rows;
  for (unsigned i = 0; i < most; ++i)
    rows.push_back(
        {i + 1, median(speeds[i]), median(processors[i]), median(yardsticks[i]), median(besides[i])});
  return rows;
}

// --- End to end

struct EndToEnd {
  double seconds = std::numeric_limits<double>::infinity();
  double processor = std::numeric_limits<double>::infinity();
  std::string line;      // of make sim
  bool rebuilt = false;  // anything, in a tree without a change
};

std::size_t cached_builds() {
  std::size_t count = 0;
  for (const auto& kind : std::filesystem::directory_iterator(c_folders.cache))
    if (kind.is_directory())
      for ([[maybe_unused]] const auto& build : std::filesystem::directory_iterator(kind)) ++count;
  return count;
}

EndToEnd measure_make() {
  EndToEnd end;
  const Command sim{.arguments = {"make", "sim", "SCENE=spheres", "OUT=" + (c_scratch / "out").string()},
                    .working_folder = c_source,
                    .environment = {{"MAKEFLAGS", ""}, {"SHADER", ""}, {"SIZE", ""}}};
  std::size_t builds = 0;
  for (int i = 0; i < 4; ++i) {  // the first may build
    const double before = children_seconds();
    const auto start = std::chrono::steady_clock::now();
    const ProcessEnd ran = must(run_process(sim, "apt-get install make"));
    if (!ran.succeeded()) fail(tool_failed("make sim failed: " + ran.output));
    if (i != 0) {
      end.seconds = std::min(end.seconds, seconds_since(start));
      end.processor = std::min(end.processor, children_seconds() - before);
      end.rebuilt = end.rebuilt || cached_builds() != builds;
    }
    builds = cached_builds();
    const std::size_t at = ran.output.find("spheres  ");
    end.line = ran.output.substr(std::min(at, ran.output.size()));
    end.line = end.line.substr(0, end.line.find('\n'));
    fmt::print(stderr, "make sim: {:.2f} s\n", seconds_since(start));
  }
  const ProcessEnd build = must(
      run_process({.arguments = {"cmake", "--build", (c_source / "build").string(), "--target", "halfway"}},
                  "apt-get install cmake"));
  end.rebuilt = end.rebuilt || build.output.find("no work to do") == std::string::npos;
  return end;
}

struct ViewRow {
  const char *shader, *what;
  std::vector<std::string> options;
  double slowest = std::numeric_limits<double>::infinity(), fastest = 0.0;  // frames a second
  std::string parts;  // what of a frame's processor time went where
};

/// What the program itself prints, as a user would see it.
std::vector<ViewRow> measure_view() {
  std::vector<ViewRow> rows = {
      {"quadratic", "PNG, compared", {}},
      {"quadratic", "PPM, compared", {"--format", "ppm"}},
      {"quadratic", "PPM, `--no-compare`", {"--format", "ppm", "--no-compare"}},
      {"quadratic", "PPM, compared, `--simulator lanes`", {"--format", "ppm", "--simulator", "lanes"}},
      {"spherical", "PNG, compared", {}},
      {"spherical", "PPM, compared, `--simulator lanes`", {"--format", "ppm", "--simulator", "lanes"}},
  };
  const std::string out = (c_scratch / "view").string();
  for (int repetition = 0; repetition < 4; ++repetition)  // the first may build
    for (ViewRow& row : rows) {
      Command view{
          .arguments = {(c_source / "build/halfway").string(), "view", "spheres", "--shader", row.shader,
                        "--size", "1000x1000", "--frames", "36", "--threads", "2", "--out", out},
          .working_folder = c_source};
      view.arguments.insert(view.arguments.end(), row.options.begin(), row.options.end());
      const ProcessEnd ran = must(run_process(view, "make"));
      if (!ran.succeeded()) fail(tool_failed("halfway view failed: " + ran.output));
      std::smatch found;
      const std::regex line(R"(\| ([0-9.]+) frames a second,[^\n]*\nprocessor time a frame: ([^\n]*))");
      if (!std::regex_search(ran.output, found, line)) fail(tool_failed("halfway view said: " + ran.output));
      if (repetition == 0) continue;
      const double rate = std::stod(found[1]);
      fmt::print(stderr, "view, {}, {}: {:.1f} frames a second\n", row.shader, row.what, rate);
      row.slowest = std::min(row.slowest, rate);
      row.fastest = std::max(row.fastest, rate);
      row.parts = std::regex_replace(found.str(2), std::regex(" ms"), "");
    }
  return rows;
}

// --- The page

std::string first_line(const std::vector<std::string>& question) {
  if (find_program(question.front()).empty() && !std::filesystem::exists(question.front())) return "not here";
  const auto end = run_process({.arguments = question}, "");
  if (!end) return "not here";
  return end->output.substr(0, end->output.find('\n'));
}

/// Of the last one and fifteen minutes: processes that would run.
std::pair<double, double> load() {
  double minutes[3] = {0, 0, 0};
  if (::getloadavg(minutes, 3) != 3) return {0, 0};
  return {minutes[0], minutes[2]};
}

std::string figure(double value) {
  if (value == 0) return "0";
  return value >= 100  ? fmt::format("{:.0f}", value)
         : value >= 10 ? fmt::format("{:.1f}", value)
                       : fmt::format("{:.2f}", value);
}

std::string percent(double part) {
  return fmt::format("{:.1f} %", 100.0 * part);
}

std::string count(std::uint64_t n) {
  std::string text = std::to_string(n);
  for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, " ");
  return text;
}

std::string ways_section(const Measurements& measurements, const WayTable& table) {
  const auto nanoseconds = [&](Way way, std::size_t column) -> std::optional<double> {
    // One picture in software for all columns.
    const std::size_t measured = way == Way::reference || way == Way::mesa ? 0 : column;
    const auto seconds = measurements.seconds(WayTable::name(way, measured));
    if (!seconds) return std::nullopt;
    return 1e9 * *seconds / static_cast<double>(table.batches(way, measured).golden.size());
  };
  std::string text =
      "\n## Ways to a picture\n\n"
      "Built-in scene `spheres`, one light. Times as long as our path takes for a fragment on one core, and "
      "a "
      "processor's time for a\nfragment. Our path is the first row; where there are no lanes, Verilator as "
      "built here, "
      "compared. *Compared* means that the golden model\ndraws the same fragments on the same core, and that "
      "every field "
      "of every fragment is held against it. RTL and golden model are\ngiven the init vectors; GHDL's time "
      "is that of its "
      "whole process, small frame and text files included. Software starts from projected\ntriangles, OpenGL "
      "from vertices "
      "in place; their picture's time is divided by our fragments.\n\n| |";
  for (const Hardware& hardware : c_hardware) text += fmt::format(" {} |", hardware.heading);
  text += "\n| --- |";
  for (std::size_t i = 0; i < c_columns; ++i) text += " --- |";
  text += "\n| frame; in GHDL |";
  for (const Hardware& hardware : c_hardware)
    text += fmt::format(" {}×{}; {}×{} |", hardware.size.width, hardware.size.height,
                        hardware.ghdl_size.width, hardware.ghdl_size.height);
  text += '\n';
  for (const Way way : c_ways) {
    text += fmt::format("| {} |", to_string(way));
    for (std::size_t column = 0; column < c_columns; ++column) {
      const auto ours =
          nanoseconds(c_hardware[column].lanes ? Way::lanes_compared : Way::verilator_compared, column);
      const auto taken = nanoseconds(way, column);
      const std::string lacks = lacking(way, c_folders);
      if (taken && ours)
        text += *taken < 1e4 ? fmt::format(" {} ({} ns) |", figure(*taken / *ours), figure(*taken))
                             : fmt::format(" {} ({} µs) |", figure(*taken / *ours), figure(1e-3 * *taken));
      else if (!lacks.empty())
        text += fmt::format(" {} is not here |", lacks);
      else
        text += " – |";
    }
    text += '\n';
  }
  return text;
}

std::string mesa_note() {
  if (!lacking(Way::mesa, c_folders).empty()) return "";
  const Scene scene = builtin("spheres");
  const WayInput input{.scene = &scene,
                       .size = c_hardware[0].size,
                       .batches = nullptr,
                       .folders = c_folders,
                       .scratch = c_scratch};
  const auto picture = draw_by_mesa(input, 1);
  if (!picture) return "";
  return fmt::format(
      "\nMesa's picture is {:.1f} dB and {}/255 beside the reference renderer's within outlines; on outlines "
      "{:.0f} of a "
      "million pixels are\nothers, as its vertices lie on 1/256 of a pixel and ours on 1/16. It counts in "
      "single "
      "precision: {}.\n",
      picture->psnr_db, picture->max_lsb, 1e6 * picture->outline_off, picture->renderer);
}

/// The same with a term for lines.
std::string lines_note(const Series& series, std::vector<Terms> rows, std::span<const double> t) {
  std::size_t i = 0;
  for (const Point& point : series.points) {
    if (point.repetitions.empty()) continue;
    const InitBatches batches =
        must(make_batches(point.scene(), point.size, {.shader = point.key.shader}, false));
    rows[i++].push_back(static_cast<double>(count_walk(batches).lines));
  }
  const Fit plane = fit(rows, t);
  if (rows.size() < 5 || plane.factors.empty()) return "";
  return fmt::format(
      "Lines of triangles are work, too, and grow with the root of the pixels: {:.3g} ms, {:.4g} ns for each "
      "of the pixels and {:.3g} ns for each of the lines\nare at most {} beside these {} frames.\n",
      1e3 * plane.factors[0], 1e9 * plane.factors[1], 1e9 * plane.factors[2],
      percent(plane.largest_deviation), rows.size());
}

std::string growth_section(const std::vector<Series>& all) {
  std::string text = fmt::format(
      "\n## Growth\n\n"
      "A frame on one core, in seconds of it: setup, golden model, RTL (in lanes; the shading processors in "
      "Verilator), "
      "comparison of every\nfield, assembly to a picture, its clearing included; the mean of 2 to 31 "
      "repetitions. Each frame is drawn in a process that has drawn the same\nfor a quarter of a second, or "
      "whole, before: as all frames of `make view` but the first. The line is t = constant + slope n "
      "with\nthe "
      "least squares of relative deviations. Memory is the most beside the mesh and the program, the drawing "
      "before and the\nframe's {} bytes a pixel included. What is beside the frame is bounded: most of it "
      "what lanes "
      "hold of large triangles,\ntwo million fragments, and a triangle's more, in room for four times as "
      "many at most,"
      "\nand room for two million kept from before.\n",
      c_frame_bytes);
  double best_pace = std::numeric_limits<double>::infinity();
  for (const Series& series : all)
    for (const Point& point : series.points)
      for (const FrameCost& cost : point.repetitions) best_pace = std::min(best_pace, cost.best_pace);
  for (const Series& series : all) {
    std::vector<double> t;
    std::vector<Terms> rows;
    for (const Point& point : series.points)
      if (!point.repetitions.empty()) {
        const FrameCost cost = typical(point, best_pace);
        rows.push_back({1.0, point.n});
        t.push_back(series.fitted == Fitted::drawing ? cost.drawing() : cost.seconds());
      }
    text += fmt::format("\n### {}\n\n{}\n\n", series.heading, series.note);
    if (rows.size() < 3) {
      text += "Not measured.\n";
      continue;
    }
    const bool fitted = series.fitted != Fitted::nothing;
    text += fmt::format(
        "| {} | init vectors, line records | fragments | setup | golden model | RTL | comparison | picture | "
        "all |{} memory, "
        "MiB (frame) |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |{} --- |\n",
        series.unit, fitted ? " beside the line |" : "", fitted ? " --- |" : "");
    const Fit line = fit(rows, t);
    std::size_t i = 0;
    for (const Point& point : series.points) {
      if (point.repetitions.empty()) continue;
      const FrameCost cost = typical(point, best_pace);
      const std::string beside = fmt::format(" {:+.1f} % |", 100.0 * (t[i] / line.at(rows[i]) - 1.0));
      ++i;
      const double frame = static_cast<double>(c_frame_bytes) * point.size.width * point.size.height;
      text += fmt::format(
          "| {} | {}, {} | {} | {:.4f} | {:.4f} | {:.4f} | {:.4f} | {:.4f} | {:.4f} |{} {:.1f} ({:.1f}) |\n",
          count(series.unit == "triangles" ? cost.triangles : static_cast<std::uint64_t>(point.n)),
          count(cost.vectors), count(cost.records), count(cost.fragments), cost.setup, cost.golden, cost.rtl,
          cost.compare, cost.assemble, cost.seconds(), fitted ? beside : "",
          static_cast<double>(cost.memory_bytes) / (1 << 20), frame / (1 << 20));
    }
    if (!fitted) continue;
    const double slope = line.factors[1];
    const bool slow = slope >= 1e-4;
    text += fmt::format("\n{:.3g} ms, and {:.4g} {} for each of the {}: at most {} beside that line.\n",
                        1e3 * line.factors[0], (slow ? 1e3 : 1e9) * slope, slow ? "ms" : "ns", series.unit,
                        percent(line.largest_deviation));
    if (series.fitted == Fitted::drawing) text += lines_note(series, rows, t);
  }
  return text;
}

std::string small_section(const std::vector<SmallRow>& rows) {
  std::string text =
      "\n## Small triangles\n\n"
      "A sphere that fills 500×500 pixels, cut finer and finer: clocks of the RTL for a fragment, and what "
      "bounds them. "
      "The line stage takes a\nline a clock, empty or not, while the span stage walks the line before, a "
      "pixel a clock: "
      "clocks are lost where a span has fewer\npixels than there are lines up to the next span. In the "
      "spherical shader "
      "a triangle's header takes two clocks before its lines; elsewhere a triangle of a single line takes "
      "two, if it has not waited for another's pixels.\n*Expected* is counted from the init vectors "
      "alone: that the "
      "RTL takes as many says that nothing else bounds it. The quadratic shader's\ntriangles are those after "
      "subdivision.\n\n"
      "| shader | triangles of the mesh | pixels a triangle | clocks a fragment | expected | lost to lines | "
      "lost to "
      "headers | a fragment: init vectors | line records | lines | empty lines |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const SmallRow& row : rows) {
    const WalkCounts& walk = row.walk;
    const auto a_fragment = [&](std::uint64_t n) {
      return fmt::format("{:.3f}", static_cast<double>(n) / static_cast<double>(walk.pixels));
    };
    text += fmt::format(
        "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", to_string(row.shader),
        count(row.triangles), figure(static_cast<double>(walk.pixels) / static_cast<double>(walk.headers)),
        a_fragment(row.cycles), a_fragment(walk.pixels + walk.lost_to_lines + walk.lost_to_headers),
        a_fragment(walk.lost_to_lines), a_fragment(walk.lost_to_headers), a_fragment(walk.headers),
        a_fragment(row.records), a_fragment(walk.lines), a_fragment(walk.empty_lines));
  }
  return text;
}

std::string cores_section(const std::map<std::string, std::vector<CoreRow>>& all) {
  std::string text =
      "\n## Cores\n\n"
      "Our path on `spheres` at 1600×1200, twelve frames, of which threads take fifths by turns. By the "
      "clock, so "
      "the load of the machine counts;\nthe processor time of all threads together says what sharing costs. "
      "Of each "
      "repetition the ratios to its one thread; the median of all.\nThe yardstick is work in registers "
      "alone, "
      "independent sums of vectors as wide as lanes', on as many threads right after each of ours. What it "
      "loses\nthe machine's processors take from one another, be they threads of one core or shared with "
      "others; only what ours loses beyond it, the last column below 100 %, is\nours: memory that threads "
      "share, or waiting.\n\n"
      "| shader | threads | times as fast by the clock | a core | processor time | the yardstick, a core | "
      "ours "
      "by the yardstick |\n| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const auto& [shader, rows] : all)
    for (const CoreRow& row : rows)
      text += fmt::format("| {} | {} | {:.2f} | {} | {:.2f} | {} | {} |\n", shader, row.threads, row.speed,
                          percent(row.speed / row.threads), row.processor,
                          percent(row.yardstick / row.threads), percent(row.beside));
  return text;
}

std::string make_section(const EndToEnd& end) {
  return fmt::format(
      "\n## End to end\n\n"
      "`make sim SCENE=spheres` in a tree without a change, all of it: set-up's look at the machine, the "
      "build's, the "
      "scene by golden\nmodel, GHDL, Verilator and reference renderer, images. The best of three: {:.2f} s "
      "by the clock, {:.2f} s of "
      "processors; built anew: {}.\n\n```\n{}\n```\n",
      end.seconds, end.processor, end.rebuilt ? "something, which is a fault" : "nothing", end.line);
}

std::string view_section(const std::vector<ViewRow>& rows) {
  std::string text =
      "\n## View\n\n"
      "`halfway view spheres --size 1000x1000 --frames 36 --threads 2`, a whole turn in pictures of a "
      "megapixel: the "
      "slowest and the\nfastest of three by the clock, and what of a frame's processor time went where in "
      "the last. "
      "The shading processors' paper asks\nfor 16 frames a second.\n\n"
      "| shader | images | frames a second | processor time a frame, ms |\n| --- | --- | --- | --- |\n";
  for (const ViewRow& row : rows)
    text += fmt::format("| {} | {} | {:.0f} to {:.0f} | {} |\n", row.shader, row.what, row.slowest,
                        row.fastest, row.parts);
  return text;
}

struct Options {
  std::filesystem::path page{}, readme{};
  unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
};

bool read_options(int argc, char** argv, Options& options) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--page" && i + 1 < argc)
      options.page = argv[++i];
    else if (argument == "--readme" && i + 1 < argc)
      options.readme = argv[++i];
    else if (argument == "--jobs" && i + 1 < argc)
      options.jobs = static_cast<unsigned>(std::clamp(std::atoi(argv[++i]), 1, 256));
    else
      return false;
  }
  // The page has all of it.
  if (options.page.empty()) return options.readme.empty();
  return benchmark::GetBenchmarkFilter().empty();
}

void write_readme(const std::filesystem::path& path, const std::string& page) {
  const ReadmeParts parts = must(readme_parts(page));
  must(rewrite_page(path, [&](const std::string& readme) { return with_readme_parts(readme, parts); }));
}

int run(const Options& options) {
  must(make_folders(c_scratch));
  const auto [load_before, ignored] = load();
  Measurements measurements;
  const WayTable ways = make_ways(measurements, options.jobs);
  std::vector<Series> series = growth_series();
  add_growth(measurements, series, options.jobs);
  benchmark::ConsoleReporter reporter(benchmark::ConsoleReporter::OO_Tabular);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  if (measurements.failed()) fail(*measurements.failed());

  std::map<std::string, std::vector<CoreRow>> cores;
  for (std::size_t column = 0; column < c_columns; ++column)
    if (c_hardware[column].lanes && is_wanted(fmt::format("cores/{}", c_hardware[column].name)))
      cores[c_hardware[column].heading] =
          measure_cores(ways.columns[column].batches, std::min(4U, std::thread::hardware_concurrency()));
  const std::vector<SmallRow> small =
      is_wanted("small_triangles") ? small_triangles() : std::vector<SmallRow>{};
  const std::optional<EndToEnd> end = is_wanted("make_sim") ? std::optional(measure_make()) : std::nullopt;
  const std::vector<ViewRow> views = is_wanted("view") ? measure_view() : std::vector<ViewRow>{};
  const auto [load_after, load_long] = load();

  std::string text =
      "# Speed\n\n"
      "What `make bench` measures, in one run; it writes this page. Ratios carry over to another machine, "
      "seconds do "
      "not. Times are those of\nthe processor, not of the clock, where nothing else is said. A shared "
      "machine's "
      "processors are now slower, now quicker: a fixed piece\nof work is timed before and after, or in long "
      "measurements all the while, and times are told at the pace of its best moment.\nEvery way of "
      "the RTL is checked "
      "to draw the right fragments, and Mesa the right picture, each time that it is timed; `make test` does "
      "so at a tiny size.\n\n";
  text += fmt::format(
      "Machine: {}. Load, processes that would run, of which one was this:\n{:.1f} before, {:.1f} after, "
      "{:.1f} "
      "over the last quarter of an hour.\n\nTools: {}; its llvm and {};\n{}; {}; {}; {}.\n",
      machine(), load_before, load_after, load_long, first_line({"ghdl", "--version"}),
      lacking(Way::ghdl_mcode, c_folders).empty() ? "mcode back ends" : "no mcode back end",
      first_line({"verilator", "--version"}), first_line({"clang++", "--version"}),
      first_line({"g++", "--version"}), first_line({"yosys", "-V"}));
  text += ways_section(measurements, ways);
  text += mesa_note();
  text += growth_section(series);
  text += small_section(small);
  text += cores_section(cores);
  if (end) text += make_section(*end);
  if (!views.empty()) text += view_section(views);
  fmt::print("\n{}", text);
  if (!options.page.empty()) must(write_file(options.page, text));
  if (!options.readme.empty()) write_readme(options.readme, text);
  return end && end->rebuilt ? 1 : 0;
}

}  // namespace
}  // namespace halfway

int main(int argc, char** argv) {
  // The load of a shared machine comes and goes: repetitions of one measurement lie apart.
  std::vector<char*> arguments(argv, argv + argc);
  std::string interleave = "--benchmark_enable_random_interleaving=true";
  arguments.insert(arguments.begin() + 1, interleave.data());
  auto count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&count, arguments.data());
  halfway::Options options;
  if (!halfway::read_options(count, arguments.data(), options)) {
    fmt::print(stderr,
               "usage: halfway_bench [--page FILE [--readme FILE]] [--jobs N] [--benchmark_filter=REGEX]\n");
    return 2;
  }
  return halfway::run(options);
}

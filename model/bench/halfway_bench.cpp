// SPDX-License-Identifier: Apache-2.0
// Speed, as ratios within one run: golden model, Verilator and lanes with comparison, GHDL, setup, and a
// million-triangle mesh as a whole process. Absolute figures belong to the machine that prints them.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <tuple>

#include "common/file.hpp"
#include "frame/init_file.hpp"
#include "plan/plan.hpp"
#include "run/golden_run.hpp"
#include "run/scene_stream.hpp"
#include "run/stream_comparator.hpp"
#include "scene/load_scene.hpp"
#include "sim/ghdl/ghdl_runner.hpp"
#include "sim/lanes/lane_simulator.hpp"
#include "sim/verilator/verilator_simulator.hpp"

namespace {

using namespace halfway;

const std::filesystem::path c_source = HALFWAY_SOURCE_DIR;
const SimulatorFolders c_folders{c_source, c_source / "build" / "cache"};

[[noreturn]] void fail(const Error& error) {
  fmt::print(stderr, "{}\n", error.message);
  std::exit(static_cast<int>(error.code));
}

template <class T>
T must(Result<T> result) {
  if (!result) fail(result.error());
  return std::move(*result);
}

// A built-in scene's init vectors and the golden model's fragments for them.
struct Stream {
  HardwareKey key;
  unsigned init_bits;
  std::vector<std::uint32_t> words;
  std::vector<Fragment> golden;
  std::vector<std::size_t> batches;  // in vectors; whole triangles
};

constexpr std::size_t c_batch = 512;  // vectors, at least

// What is measured: a shader, the shading processors in either form.
struct Hardware {
  const char* name;
  PlanRequest plan;
};
const Hardware c_hardware[] = {
    {"quadratic", {.shader = Shader::quadratic}},
    {"spherical", {.shader = Shader::spherical}},
    {"processors", {.shader = Shader::processors}},
    {"folded_processors", {.shader = Shader::processors, .form = ProcessorForm::folded}}};

const Stream& stream_of(const Hardware& hardware, const std::string& name, FrameSize size) {
  static std::map<std::tuple<std::string, std::string, std::uint32_t>, Stream> streams;
  const auto [it, fresh] = streams.try_emplace({hardware.name, name, size.width});
  Stream& s = it->second;
  if (!fresh) return s;
  const Scene scene = must(load_scene(name, c_source / "sim" / "scenes"));
  s.key = must(plan_scene(scene, hardware.plan)).key;
  const std::unique_ptr<Setup> setup = make_setup(scene, size, s.key, {});
  s.init_bits = setup->init_bits();
  SceneStream source(*setup, s.key, 1);
  for (Batch batch; source.next(batch);) {
    s.words.insert(s.words.end(), batch.init_words.begin(), batch.init_words.end());
    s.golden.insert(s.golden.end(), batch.golden.begin(), batch.golden.end());
  }
  const std::unique_ptr<GoldenModel> golden = make_golden_model(s.key);
  const std::size_t words_per_vector = (s.init_bits + 31) / 32;
  std::size_t vectors = 0;
  for (auto rest = std::span<const std::uint32_t>(s.words); !rest.empty();) {
    const std::size_t triangle = golden->group(rest);
    rest = rest.subspan(triangle * words_per_vector);
    vectors += triangle;
    if (vectors < c_batch && !rest.empty()) continue;
    s.batches.push_back(vectors);
    vectors = 0;
  }
  return s;
}

constexpr FrameSize c_large{1600, 1200}, c_small{320, 240};

void report_fragments(benchmark::State& state, std::size_t fragments) {
  state.counters["fragments/s"] =
      benchmark::Counter(static_cast<double>(fragments), benchmark::Counter::kIsIterationInvariantRate);
}

void setup(benchmark::State& state, const Hardware& hardware) {
  const Scene scene = must(load_scene("teapot", c_source / "sim" / "scenes"));
  const HardwareKey key = must(plan_scene(scene, hardware.plan)).key;
  const std::unique_ptr<Setup> maker = make_setup(scene, c_large, key, {});
  SetupCounts counts;
  for (auto _ : state) {
    counts = {};
    std::vector<std::uint32_t> words;
    for (std::uint32_t unit = 0; unit < maker->units(); ++unit) maker->append(unit, words, counts);
    benchmark::DoNotOptimize(words.data());
  }
  state.counters["vectors/s"] = benchmark::Counter(static_cast<double>(counts.vectors + counts.records),
                                                   benchmark::Counter::kIsIterationInvariantRate);
}

void golden_model(benchmark::State& state, const Hardware& hardware, const char* scene) {
  const Stream& s = stream_of(hardware, scene, c_large);
  const std::unique_ptr<GoldenModel> golden = make_golden_model(s.key);
  std::vector<Fragment> fragments;
  fragments.reserve(s.golden.size());
  for (auto _ : state) {
    fragments.clear();
    golden->draw(s.words, fragments);
    benchmark::DoNotOptimize(fragments.data());
  }
  report_fragments(state, s.golden.size());
}

// Hardware alone, then with the golden model drawing the same on the same core and every field compared.
void verilator(benchmark::State& state, const Hardware& hardware, const char* scene, bool compared) {
  const Stream& s = stream_of(hardware, scene, c_large);
  auto simulator = must(VerilatorSimulator::open(s.key, c_folders));
  const std::unique_ptr<GoldenModel> golden = make_golden_model(s.key);
  const std::size_t words_per_vector = (s.init_bits + 31) / 32;
  std::vector<Fragment> drawn;
  drawn.reserve(1 << 20);
  const std::uint64_t before = simulator.cycles();
  for (auto _ : state) {
    StreamComparator comparator;
    std::span<const Fragment> expected;
    const auto take = [&] {
      if (compared) comparator.add(expected, drawn);
      expected = {};
      drawn.clear();
    };
    auto rest = std::span<const std::uint32_t>(s.words);
    for (const std::size_t count : s.batches) {
      const auto words = rest.first(count * words_per_vector);
      rest = rest.subspan(words.size());
      if (compared) expected = golden->draw(words);
      if (const Status ran = simulator.run(words, count, drawn, SIZE_MAX); !ran) fail(ran.error());
      take();
    }
    if (const Status ended = simulator.finish(drawn, SIZE_MAX); !ended) fail(ended.error());
    take();
    comparator.finish();
    if (comparator.mismatches() != 0) {
      state.SkipWithError("the RTL differs from the golden model");
      return;
    }
  }
  report_fragments(state, s.golden.size());
  state.counters["cycles/fragment"] =
      static_cast<double>(simulator.cycles() - before) /
      (static_cast<double>(s.golden.size()) * static_cast<double>(state.iterations()));
}

// The same in lanes; each of the benchmark's threads draws all of the scene.
void lanes(benchmark::State& state, const Hardware& hardware, const char* scene, bool compared) {
  static std::mutex mutex;
  std::unique_lock lock(mutex);
  const Stream& s = stream_of(hardware, scene, c_large);
  auto simulator = must(LaneSimulator::open(s.key, c_folders));
  lock.unlock();
  const std::unique_ptr<GoldenModel> golden = make_golden_model(s.key);
  for (auto _ : state) {
    StreamComparator comparator;
    std::size_t drawn = 0;
    const Status ran = simulator.run(s.words, SIZE_MAX, [&](auto words, auto fragments) {
      drawn += fragments.size();
      if (compared) comparator.add(golden->draw(words), fragments);
    });
    if (!ran) fail(ran.error());
    comparator.finish();
    if (drawn != s.golden.size() || comparator.mismatches() != 0) {
      state.SkipWithError("the RTL differs from the golden model");
      return;
    }
  }
  report_fragments(state, s.golden.size());
}

void ghdl(benchmark::State& state, const Hardware& hardware, const char* scene) {
  const Stream& s = stream_of(hardware, scene, c_small);
  const auto runner = must(GhdlRunner::open(s.key, c_folders));
  const std::filesystem::path folder = c_source / "build" / "bench";
  if (const Status made = make_folders(folder); !made) fail(made.error());
  if (const Status wrote = write_init_file(folder / "init.txt", s.key.name(), {s.init_bits, s.words}); !wrote)
    fail(wrote.error());
  for (auto _ : state) {
    const GhdlRun run = must(runner.run(folder / "init.txt", folder / "ghdl.trace"));
    state.SetIterationTime(run.seconds);
  }
  report_fragments(state, s.golden.size());
}

// The whole of `halfway sim` on a mesh of a million triangles: seconds and peak memory of the process.
void million_triangles(benchmark::State& state) {
  const std::filesystem::path folder = c_source / "build" / "bench";
  if (const Status made = make_folders(folder); !made) fail(made.error());
  const std::filesystem::path scene = folder / "million.toml";
  if (const Status wrote =
          write_file(scene,
                     "[camera]\nfit = true\n[[directional]]\nto_light = [1.0, 2.0, 3.0]\n"
                     "[[material]]\nname = \"m\"\ncolour = [0.8, 0.5, 0.3]\n"
                     "[[mesh]]\nkind = \"sphere\"\nslices = 709\nstacks = 707\nmaterial = \"m\"\n");
      !wrote)
    fail(wrote.error());
  const std::string program = c_source / "build" / "halfway", scene_name = scene, out = folder / "out";
  for (auto _ : state) {
    const pid_t child = fork();
    if (child == 0) {
      execl(program.c_str(), program.c_str(), "sim", "--simulator", "verilator", "--size", "1920x1080",
            "--out", out.c_str(), "--", scene_name.c_str(), nullptr);
      _exit(127);
    }
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
      state.SkipWithError("halfway sim failed");
      return;
    }
    state.counters["peak_MiB"] = static_cast<double>(usage.ru_maxrss) / 1024.0;
    state.counters["cpu_s"] = static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                              1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
  }
}

// Keeps each benchmark's rate to print ratios at the end.
class Ratios final : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs)
      if (const auto rate = run.counters.find("fragments/s");
          !run.error_occurred && rate != run.counters.end())
        rates_[run.benchmark_name()] = rate->second.value;
  }
  void Finalize() override {
    const auto rate = [&](std::string_view part) {
      for (const auto& [name, value] : rates_)
        if (name.find(part) != std::string::npos && !name.ends_with("threads:2") &&
            !name.ends_with("threads:4"))
          return value;
      return 0.0;
    };
    for (const Hardware& hardware : c_hardware) {
      const std::string of = fmt::format("/{}/spheres", hardware.name);
      const double compared = rate("verilator_compared" + of), golden = rate("golden" + of);
      const double alone = rate("verilator" + of), in_ghdl = rate("ghdl" + of);
      const double in_lanes = rate("lanes" + of), lanes_compared = rate("lanes_compared" + of);
      if (compared == 0.0 || golden == 0.0 || in_ghdl == 0.0) continue;
      fmt::print(
          "\n{}, spheres, fragments a second a core, as ratios within this run:\n"
          "  Verilator with comparison        1.00  ({:.1f} million)\n"
          "  Verilator alone                  {:.2f}\n  golden model alone               {:.2f}\n"
          "  GHDL                             1/{:.0f}\n",
          hardware.name, compared / 1e6, alone / compared, golden / compared, compared / in_ghdl);
      if (in_lanes == 0.0 || lanes_compared == 0.0) continue;
      fmt::print("  lanes with comparison            {:.2f}\n  lanes alone                      {:.2f}\n",
                 lanes_compared / compared, in_lanes / compared);
    }
  }

 private:
  std::map<std::string, double> rates_;
};

}  // namespace

int main(int argc, char** argv) {
  for (const Hardware& hardware : c_hardware) {
    const auto add = [&](const char* what, const char* scene, auto&&... arguments) {
      return benchmark::RegisterBenchmark(fmt::format("{}/{}/{}", what, hardware.name, scene).c_str(),
                                          arguments...)
          ->Unit(benchmark::kMillisecond);
    };
    add("setup", "teapot", setup, hardware);
    for (const char* scene : {"spheres", "matte"}) {
      add("golden", scene, golden_model, hardware, scene);
      add("verilator", scene, verilator, hardware, scene, false);
      add("verilator_compared", scene, verilator, hardware, scene, true);
      if (hardware.plan.shader == Shader::processors)
        continue;  // no lanes: it has more than a triangle's state
      add("lanes", scene, lanes, hardware, scene, false);
      add("lanes_compared", scene, lanes, hardware, scene, true)->ThreadRange(1, 4);
    }
    add("ghdl", "spheres", ghdl, hardware, "spheres")->UseManualTime()->Iterations(1);
  }
  benchmark::RegisterBenchmark("million_triangles/1920x1080", million_triangles)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->Iterations(1);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Ratios ratios;
  benchmark::RunSpecifiedBenchmarks(&ratios);
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
// `halfway sim`: scenes through golden model, GHDL and Verilator.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <future>
#include <mutex>
#include <optional>
#include <thread>

#include "common/to_integer.hpp"
#include "plan/own_bells.hpp"
#include "sim/cli/options.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/generator/generated_files.hpp"
#include "sim/generator/word_lengths/made_tables.hpp"
#include "sim/os/must.hpp"
#include "sim/os/printable.hpp"
#include "sim/run/simulate.hpp"

namespace halfway::cli {
namespace {

struct SimOptions {
  DrawOptions draw;
  std::vector<std::string> scenes;
  std::vector<std::string> simulators;
  std::uint32_t stall_seed = 0;
  bool own_tables = false;
};

// The current step of each scene, on one line of a terminal.
class Board {
 public:
  explicit Board(const std::vector<std::string>& scenes)
      : scenes_(scenes), states_(scenes.size()), progress_("sim") {}

  void show(std::size_t scene, std::string state) {
    const std::scoped_lock lock(mutex_);
    if (states_[scene] == state) return;
    states_[scene] = std::move(state);
    std::string text;
    for (std::size_t i = 0; i < scenes_.size(); ++i)
      if (!states_[i].empty())
        text += fmt::format("{}{} {}", text.empty() ? "" : " | ", scenes_[i], states_[i]);
    progress_.show(text);
  }
  void clear() {
    const std::scoped_lock lock(mutex_);
    progress_.clear();
  }

 private:
  std::mutex mutex_;
  std::vector<std::string> scenes_, states_;
  Progress progress_;
};

// Preset exact of the spherical shader, with a table for each exponent of the scene: in memory for the golden
// model, and in a copy of the RTL in the cache.
void take_own_tables(const Scene& scene, SimulateSettings& settings,
                     std::optional<tables::MadeTables>& made) {
  std::vector<double> own = must(own_exponents(scene));
  const words::CosineSize size = settings.plan.tables.value_or(tables::c_own_size);
  made.emplace(true, size, own);
  settings.folders.source =
      tables::rtl_with(true, size, {}, settings.folders.source, settings.folders.cache, own);
  settings.plan.tables = size;
  settings.plan.made_tables = made->tables();
  settings.plan.own = std::move(own);
}

SceneSummary draw_scene(const std::string& name, std::size_t number, const Folders& folders,
                        SimulateSettings settings, bool own_tables, Board& board) {
  board.show(number, "loading");
  const Scene scene = must(load_scene(name, folders.scenes()));
  std::optional<tables::MadeTables> made;
  if (own_tables) take_own_tables(scene, settings, made);
  settings.on_progress = [&](const std::string& what, double done) {
    board.show(number, done < 0.0 ? what : fmt::format("{} {} %", what, to_integer<int>(100.0 * done)));
  };
  settings.on_wait = [&](const std::filesystem::path& folder) {
    board.clear();
    say_waiting(folder);
  };
  auto summary = caught([&] { return simulate(scene, settings); });
  board.show(number, "");
  return must(std::move(summary));
}

// Returns true if at least one fragment was compared and all are equal.
bool print(const SceneSummary& summary) {
  for (const std::string& note : summary.notes) say(note);
  fmt::print("{}\n", printable(to_line(summary)));
  std::fflush(stdout);
  for (const SimulatorRun& run : summary.runs) {
    if (run.equal()) continue;
    say(fmt::format("{}: {} differs from the golden model", summary.scene, run.simulator));
    if (!run.fault.empty()) say("  " + run.fault);
    fmt::print(stderr, "{}", run.description);
    for (const auto& path : run.evidence) say("  see " + path);
  }
  const auto nothing = summary.nothing_compared();
  if (nothing) say(fmt::format("{}: {}", summary.scene, *nothing));
  return summary.equal() && !nothing;
}

int run(const Folders& folders, const SimOptions& options) {
  const DrawSettings draw = checked(options.draw);
  if (options.own_tables && (draw.plan.shader != Shader::spherical || draw.plan.preset != Preset::exact))
    throw_bad_input("--own-tables belongs to the spherical shader in preset exact");
  SimulateSettings settings{draw, checked_simulators(options.simulators), options.stall_seed, draw.out};
  settings.folders = {folders.source, folders.cache()};
  const std::vector<std::string> scenes = options.scenes.empty() ? builtin_scenes(folders) : options.scenes;

  // Results are stored under the scene's name, so two scenes must not have the same one.
  for (std::size_t i = 0; i < scenes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (result_name(scenes[i]) == result_name(scenes[j]))
        throw_bad_input(
            "{}: its results would overwrite those of {}; draw them one at a time, or into another --out",
            scenes[i], scenes[j]);

  for (const std::string& scene : scenes) {
    const auto files = ResultFiles::of(settings.out, result_name(scene), settings.plan);
    forget_summary(files, [&] { say_waiting(files.folder); });
  }

  // Run scenes in parallel: GHDL uses one core and takes most of the time.
  const unsigned workers = std::clamp<unsigned>(static_cast<unsigned>(scenes.size()), 1, draw.threads);
  settings.threads = std::max(1U, draw.threads / workers);
  Board board(scenes);
  std::vector<std::promise<SceneSummary>> outcomes(scenes.size());
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> stop = false;
  std::vector<std::jthread> pool;
  for (unsigned i = 0; i < workers; ++i)
    pool.emplace_back([&] {
      for (std::size_t n = next++; n < scenes.size(); n = next++) try {
          if (stop) return;
          outcomes[n].set_value(draw_scene(scenes[n], n, folders, settings, options.own_tables, board));
        } catch (...) {
          outcomes[n].set_exception(std::current_exception());
        }
    });

  // Frames may be equal although a generated file was changed: for example, a wrong table entry for an angle
  // that no scene contains.
  bool equal = true;
  for (const std::string& message : tables::stale_files(folders.source, tables::compiled_sizes(), false)) {
    board.clear();
    fmt::print(stderr, "{}\n", message);
    equal = false;
  }
  for (std::promise<SceneSummary>& outcome : outcomes) try {
      const SceneSummary summary = outcome.get_future().get();
      board.clear();
      equal = print(summary) && equal;
    } catch (...) {
      board.clear();
      stop = true;
      throw;
    }
  return static_cast<int>(equal ? ExitCode::equal : ExitCode::differs);
}

}  // namespace

void add_sim(CLI::App& app, const Folders& folders, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("sim", "draw scenes by golden model, GHDL and Verilator and compare");
  auto options = std::make_shared<SimOptions>();
  command->add_option("scene", options->scenes,
                      "a built-in scene's name, a scene file (.toml) or a mesh (.obj .ply .stl .gltf .glb);\n"
                      "default: all built-in scenes");
  options->draw.add_to(*command);
  command->add_option("--simulator", options->simulators,
                      "ghdl or verilator (default: both), or lanes: many copies of the RTL at once (see\n"
                      "sim/extras/lanes), which report no cycles");
  command->add_flag(
      "--own-tables", options->own_tables,
      fmt::format("spherical, preset exact: a table of cos^n for each exponent n of the scene, up "
                  "to {},\nof {} address x data bits or the size given: within one colour step",
                  tables::c_most_own_tables, to_string(tables::c_own_size)));
  command
      ->add_option("--stalls", options->stall_seed,
                   "stall both streams at random, with this seed (0: full speed)")
      ->capture_default_str();
  command->callback([=, &folders, &exit_code] { exit_code = run(folders, *options); });
}

}  // namespace halfway::cli

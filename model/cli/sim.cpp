// SPDX-License-Identifier: Apache-2.0
// `halfway sim`: scenes through golden model, GHDL and Verilator.
#include <fmt/format.h>

#include <cstdio>

#include "cli/options.hpp"
#include "run/simulate.hpp"
#include "scene/load_scene.hpp"

namespace halfway::cli {
namespace {

struct SimOptions {
  DrawOptions draw;
  std::vector<std::string> scenes;
  std::vector<std::string> simulators;
  std::uint32_t stall_seed = 0;
};

int run(const Folders& folders, const SimOptions& options) {
  const auto draw = checked(options.draw);
  if (!draw) return report(draw.error());
  SimulateSettings settings;
  settings.shader = options.draw.shader;
  settings.preset = draw->preset;
  settings.size = draw->size;
  settings.setup = draw->setup;
  settings.threads = draw->threads;
  settings.out = draw->out;
  settings.stall_seed = options.stall_seed;
  settings.folders = {folders.source, folders.cache()};
  if (!options.simulators.empty()) {
    settings.ghdl = settings.verilator = false;
    for (const std::string& name : options.simulators) {
      if (name == "ghdl")
        settings.ghdl = true;
      else if (name == "verilator")
        settings.verilator = true;
      else
        return report(bad_input(fmt::format("--simulator: '{}' is not a simulator; take ghdl or verilator", name)));
    }
  }
  std::vector<std::string> scenes = options.scenes;
  if (scenes.empty()) {
    auto builtin = builtin_scenes(folders);
    if (!builtin) return report(builtin.error());
    scenes = std::move(*builtin);
  }

  bool equal = true;
  for (const std::string& name : scenes) {
    Progress progress(name);
    progress.show("loading");
    const auto scene = load_scene(name, folders.scenes());
    if (!scene) {
      progress.clear();
      return report(scene.error());
    }
    progress.clear();
    for (const std::string& note : scene->notes) fmt::print(stderr, "{}\n", note);
    settings.on_progress = [&](const std::string& what, double done) {
      progress.show(done < 0.0 ? what : fmt::format("{}: {} %", what, static_cast<int>(100.0 * done)));
    };
    const auto summary = simulate(*scene, settings);
    progress.clear();
    if (!summary) return report(summary.error());
    fmt::print("{}\n", to_line(*summary));
    std::fflush(stdout);
    for (const SimulatorRun& run : summary->runs) {
      if (run.equal()) continue;
      equal = false;
      fmt::print(stderr, "{}: {} differs from the golden model\n", summary->scene, run.simulator);
      if (!run.fault.empty()) fmt::print(stderr, "  {}\n", run.fault);
      fmt::print(stderr, "{}", run.description);
      for (const auto& path : run.evidence) fmt::print(stderr, "  see {}\n", path.string());
    }
  }
  return static_cast<int>(equal ? ExitCode::equal : ExitCode::differs);
}

}  // namespace

void add_sim(CLI::App& app, const Folders& folders, int& exit_code) {
  CLI::App* command = app.add_subcommand("sim", "draw scenes by golden model, GHDL and Verilator and compare");
  auto options = std::make_shared<SimOptions>();
  command->add_option("scene", options->scenes,
                      "a built-in scene's name, a scene file (.toml) or a mesh (.obj .ply .stl .gltf .glb);\n"
                      "none: all built-in scenes");
  options->draw.add_to(*command);
  command->add_option("--simulator", options->simulators, "ghdl or verilator (default: both)");
  command->add_option("--stalls", options->stall_seed, "stall both streams at random, by this seed (0: full speed)")
      ->capture_default_str();
  command->callback([=, &exit_code] { exit_code = run(folders, *options); });
}

}  // namespace halfway::cli

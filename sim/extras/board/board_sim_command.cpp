// SPDX-License-Identifier: Apache-2.0
// `halfway board-sim`: the whole board between models of its host, its SRAM and a monitor, in Verilator and
// in GHDL.
#include <fmt/format.h>

#include <cstdio>

#include "plan/plan.hpp"
#include "sim/cli/options.hpp"
#include "sim/extras/board/board_check.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/must.hpp"

namespace halfway::cli {
namespace {

using board::Host;

struct BoardSimCommand {
  std::vector<std::string> scenes, simulators;
  std::string out = "build/out";
  double threshold = 8.0;
  std::string socket;
};

/// The scene of about 20 visible triangles that GHDL draws by default.
constexpr const char* c_small_scene = "sim/extras/board/board_small.toml";

void simulate_board(const std::string& name, EngineKind simulator, Host host, const BoardSimCommand& command,
                    const Folders& folders) {
  const auto scene = must(load_scene(name, folders.scenes()));
  for (const std::string& note : scene.notes) say(note);
  must(plan_scene(scene, {.degree = board::board_key().degree}));
  const std::string host_name = host == Host::steady ? "steady" : "unreliable";
  board::BoardCheckOptions options;
  options.host = host;
  options.ghdl = simulator == EngineKind::ghdl;
  options.out = std::filesystem::path(command.out) / result_name(name) /
                fmt::format("board-{}-{}", to_string(simulator), host_name);
  options.setup.quadratic.threshold = command.threshold;
  // GHDL is slow: do not split triangles.
  if (options.ghdl) options.setup.quadratic.test = HighlightTest::none;
  Progress progress("board-sim");
  progress.show(fmt::format("{} in {}, {} host", name, to_string(simulator), host_name));
  const auto check = board::check_board(scene, options, {folders.source, folders.cache()});
  progress.clear();
  fmt::print(
      "{:<10} {:<9} {:<10}  {} vectors, {} fragments | {} packets, {} dropped, {} clocks | {} pictures equal "
      "| {} pixels by 16 bits of depth\n",
      scene.name, to_string(simulator), host_name, check.vectors, check.fragments, check.packets,
      check.dropped, check.clocks, check.pictures, check.depth_pixels);
  std::fflush(stdout);
}

/// Simulates the board for another program.
void serve(const Folders& folders, const BoardSimCommand& command) {
  const auto report_of = board::serve_board(command.socket, command.out, {folders.source, folders.cache()});
  fmt::print(
      "{}: {} packets, {} of them vectors, {} clocks; {} different pictures, all equal to the twin's\n",
      command.socket, report_of.packets, report_of.vectors, report_of.clocks, report_of.different_pictures);
}

void run(const Folders& folders, const BoardSimCommand& command) {
  if (!command.socket.empty()) return serve(folders, command);
  if (!(command.threshold > 0.0)) throw_bad_input("--threshold: {} is not above 0", command.threshold);
  // Without scenes: all built-in ones in Verilator, the small one in GHDL. GHDL draws other scenes only if it
  // is named.
  constexpr EngineKind c_known[] = {EngineKind::ghdl, EngineKind::verilator};
  auto simulators = checked_simulators(command.simulators, c_known);
  if (command.simulators.empty() && !command.scenes.empty()) simulators = {EngineKind::verilator};
  for (const EngineKind simulator : simulators) {
    const bool ghdl = simulator == EngineKind::ghdl;
    std::vector<std::string> scenes = command.scenes;
    if (scenes.empty() && ghdl) scenes = {(folders.source / c_small_scene).string()};
    if (scenes.empty()) scenes = builtin_scenes(folders);
    for (const std::string& scene : scenes) {
      // A run in GHDL takes minutes, and the unreliable host also sends good packets.
      if (!ghdl) simulate_board(scene, simulator, Host::steady, command, folders);
      simulate_board(scene, simulator, Host::unreliable, command, folders);
    }
  }
}

}  // namespace

void add_board_sim(CLI::App& app, const Folders& folders, int&) {
  CLI::App* sub = app.add_subcommand(
      "board-sim", "draw two frames on the simulated board and compare every picture of its monitor");
  auto command = std::make_shared<BoardSimCommand>();
  sub->add_option("scene", command->scenes,
                  "as for sim (default: all built-in scenes in Verilator, a small one in GHDL)");
  sub->add_option("--simulator", command->simulators,
                  "ghdl or verilator (default: both; with a scene: verilator)");
  sub->add_option("--out", command->out, "folder for results")->capture_default_str();
  sub->add_option("--threshold", command->threshold,
                  "error above which a triangle is split, in colour steps of 1/255")
      ->capture_default_str();
  sub->add_option("--serve", command->socket,
                  "a Unix socket to listen at: another program sends the packets (see docs/library.md);\n"
                  "different pictures of the monitor are written to the folder of --out");
  sub->callback([=, &folders] { run(folders, *command); });
}

}  // namespace halfway::cli

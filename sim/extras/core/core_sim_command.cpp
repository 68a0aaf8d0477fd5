// SPDX-License-Identifier: Apache-2.0
// `halfway core-sim`: scenes by the whole core in Verilator, from the driver's registers to the picture in
// memory.
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "plan/plan.hpp"
#include "sim/cli/options.hpp"
#include "sim/extras/core/core_check.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/must.hpp"
#include "sim/os/printable.hpp"
#include "sim/os/threads.hpp"
#include "sim/run/result_files.hpp"

namespace halfway::cli {
namespace {

constexpr unsigned c_most_latency = 10'000;

struct CoreSimCommand {
  DrawOptions draw;
  std::vector<std::string> scenes;
  CoreOptions core;
  core::MemoryTiming timing;
  std::string socket;
};

/// The core that the scene needs.
core::CoreKey key_for(const Scene& scene, const CoreSimCommand& command) {
  return {.shader = must(plan_scene(scene, checked(command.draw).plan)).key,
          .format = command.core.true_colour() ? core::PixelFormat::xrgb8888 : core::PixelFormat::rgb565,
          .bus_bits = command.core.bus_bits};
}

Scene loaded(const std::string& name, const Folders& folders) {
  Scene scene = must(load_scene(name, folders.scenes()));
  for (const std::string& note : scene.notes) say(note);
  return scene;
}

void draw_scene(const std::string& name, const Folders& folders, const CoreSimCommand& command) {
  const DrawSettings draw = checked(command.draw);
  const Scene scene = loaded(name, folders);
  Progress progress("core-sim");
  progress.show(scene.name);
  const auto drawn = caught([&] {
    return core::check_core(
        scene, key_for(scene, command),
        {.size = draw.size,
         .frame = {.setup = draw.setup, .workers = on_threads(draw.threads)},
         .timing = command.timing,
         .picture = ResultFiles::of(draw.out, result_name(name), draw.plan).frame("core")},
        {folders.source, folders.cache()});
  });
  progress.clear();
  if (!drawn) throw Failure{{drawn.error().code, fmt::format("{}: {}", scene.name, drawn.error().message)}};
  const core::CoreFigures& figures = *drawn;
  const auto share = [&](std::uint64_t clocks) {
    return 100.0 * static_cast<double>(clocks) / static_cast<double>(figures.clocks);
  };
  fmt::print(
      "{:<12} {:<10} {:<9} {:>4}x{:<4} {:>8} triangle packets {:>9} fragments | {}, bus {}, latency {}: {} "
      "clocks, {:.3f} fragments per clock, memory equal | clocks with a word read {:.0f} %, written {:.0f} "
      "%, "
      "with a waiting fragment {:.0f} %\n",
      printable(scene.name), to_string(draw.plan.shader), to_string(draw.plan.preset), draw.size.width,
      draw.size.height, figures.triangles, figures.fragments, command.core.format, command.core.bus_bits,
      command.timing.latency, figures.clocks, share(figures.fragments) / 100.0, share(figures.words_read),
      share(figures.words_written), share(figures.stalled_clocks));
  std::fflush(stdout);
}

/// Simulates the core of a scene for another program.
void serve(const Folders& folders, const CoreSimCommand& command) {
  if (command.scenes.size() != 1) throw_bad_input("--serve: give one scene, for which the core is made");
  const Scene scene = loaded(command.scenes[0], folders);
  const auto report_of = core::serve_core(key_for(scene, command), command.timing, command.socket,
                                          {folders.source, folders.cache()});
  fmt::print("{}: {} accesses to registers, {} clocks\n", command.socket, report_of.accesses,
             report_of.clocks);
}

void run(const Folders& folders, const CoreSimCommand& command) {
  if (command.timing.latency < 1 || command.timing.latency > c_most_latency)
    throw_bad_input("--latency: {} is not 1 to {}", command.timing.latency, c_most_latency);
  if (!command.socket.empty()) return serve(folders, command);
  for (const std::string& scene : command.scenes.empty() ? builtin_scenes(folders) : command.scenes)
    draw_scene(scene, folders, command);
}

}  // namespace

void add_core_sim(CLI::App& app, const Folders& folders, int&) {
  CLI::App* sub = app.add_subcommand(
      "core-sim", "draw scenes by the whole core in Verilator, and compare its memory byte by byte");
  auto command = std::make_shared<CoreSimCommand>();
  sub->add_option("scene", command->scenes, "as for sim (default: all built-in scenes)");
  command->draw.add_to(*sub);
  command->core.add_to(*sub);
  sub->add_option("--latency", command->timing.latency,
                  "clocks from an address to its first word, and from a write's last word to its response")
      ->capture_default_str();
  sub->add_option("--stalls", command->timing.pause_seed,
                  "pause all channels of the memory at random, with this seed (0: full speed)")
      ->capture_default_str();
  sub->add_option(
      "--serve", command->socket,
      "a Unix socket to listen at: another program accesses the registers (see docs/rtl/core.md)");
  sub->callback([=, &folders] { run(folders, *command); });
}

}  // namespace halfway::cli

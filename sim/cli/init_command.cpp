// SPDX-License-Identifier: Apache-2.0
// `halfway init`: writes a scene's init vectors to a file and prints setup's counts.
#include <fmt/format.h>

#include "plan/plan.hpp"
#include "sim/cli/options.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/files/init_file.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/must.hpp"
#include "sim/os/threads.hpp"

namespace halfway::cli {
namespace {

struct InitCommand {
  DrawOptions draw;
  std::string scene;
  std::string file;
};

int run(const Folders& folders, const InitCommand& command) {
  const auto draw = checked(command.draw);
  const auto scene = must(load_scene(command.scene, folders.scenes()));
  for (const std::string& note : scene.notes) say(note);
  const auto plan = must(plan_scene(scene, draw.plan));
  const HardwareKey& key = plan.key;
  FrameDriver driver(scene, draw.size, key, {}, {.setup = draw.setup, .workers = on_threads(draw.threads)});
  auto file = must(InitFileWriter::open(command.file, key.name(), driver.init_bits()));
  Progress progress(scene.name);
  must(driver.draw([&](const Batch& batch) {
    progress.show(batch.done);
    file.write(batch.init_words);
    return Status(Ok{});
  }));
  progress.clear();
  for (const std::string& note : driver.notes()) say(fmt::format("{}: {}", scene.name, note));
  must(file.commit());
  const SetupCounts& n = driver.counts();
  fmt::print("{}: {} init vectors and {} line records, of {} bits, for {}\n", command.file, n.vectors,
             n.records, driver.init_bits(), key.name());
  fmt::print(
      "  {} triangles: {} back-facing, {} outside, {} degenerate on the screen; {} drawn, {} of them {}: "
      "{} pieces in all, in {} init vectors and {} line records; {} points {}\n",
      scene.triangles.size(), n.projection.back_facing, n.projection.outside + n.projection.behind_near,
      n.projection.degenerate, n.triangles, n.subdivided,
      key.shader == Shader::quadratic ? "split in four" : "cut into strips", n.leaves, n.vectors, n.records,
      n.shaded, key.shader == Shader::quadratic ? "shaded" : "where vectors were computed");
  return 0;
}

}  // namespace

void add_init(CLI::App& app, const Folders& folders, int& exit_code) {
  CLI::App* sub = app.add_subcommand("init", "write a scene's init vectors");
  auto command = std::make_shared<InitCommand>();
  command->file = "init.txt";
  sub->add_option("scene", command->scene, "as for sim")->required();
  command->draw.add_to(*sub);
  sub->add_option("--file", command->file, "file to write")->capture_default_str();
  sub->callback([=, &folders, &exit_code] { exit_code = run(folders, *command); });
}

}  // namespace halfway::cli

// SPDX-License-Identifier: Apache-2.0
// `halfway init`: writes a scene's init vectors to a file and prints setup's counts.
#include <fmt/format.h>

#include "plan/plan.hpp"
#include "setup/check_counts.hpp"
#include "sim/cli/options.hpp"
#include "sim/run/scene_stream.hpp"
#include "sim/scene_files/load_scene.hpp"
#include "sim/stream_files/init_file.hpp"

namespace halfway::cli {
namespace {

struct InitCommand {
  DrawOptions draw;
  std::string scene;
  std::string file;
};

int run(const Folders& folders, const InitCommand& command) {
  const auto draw = checked(command.draw);
  if (!draw) return report(draw.error());
  const auto scene = load_scene(command.scene, folders.scenes());
  if (!scene) return report(scene.error());
  for (const std::string& note : scene->notes) say(note);
  const auto plan = plan_scene(*scene, draw->plan);
  if (!plan) return report(plan.error());
  const HardwareKey& key = plan->key;
  const std::unique_ptr<Setup> setup = make_setup(*scene, draw->size, key, draw->setup);
  auto file = InitFileWriter::open(command.file, key.name(), setup->init_bits());
  if (!file) return report(file.error());
  Progress progress(scene->name);
  SceneStream stream(*setup, key, draw->threads);
  for (Batch batch; stream.next(batch);) {
    progress.show(batch.done);
    if (const Status status = check_shadow_counts(*scene, stream.counts(), stream.fault()); !status)
      return report(status.error());
    file->write(batch.init_words);
  }
  progress.clear();
  for (const std::string& note : setup->notes()) say(fmt::format("{}: {}", scene->name, note));
  if (const Status status = file->commit(); !status) return report(status.error());
  const SetupCounts& n = stream.counts();
  fmt::print("{}: {} init vectors and {} line records, of {} bits, for {}\n", command.file, n.vectors,
             n.records, setup->init_bits(), key.name());
  fmt::print(
      "  {} triangles: {} back-facing, {} outside, {} degenerate on the screen; {} drawn, {} of them {}: "
      "{} pieces in all, in {} init vectors and {} line records; {} points {}\n",
      scene->triangles.size(), n.projection.back_facing, n.projection.outside + n.projection.behind_near,
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

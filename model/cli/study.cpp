// SPDX-License-Identifier: Apache-2.0
// `halfway study`: accuracy against time over a space of designs.
#include "study/study.hpp"

#include <fmt/format.h>

#include <thread>

#include "cli/options.hpp"
#include "common/file.hpp"

namespace halfway::cli {
namespace {

struct StudyCommand {
  std::string scene, space;
  std::string out = "build/study";
  unsigned threads = 0;
};

int run(const Folders& folders, const StudyCommand& command) {
  const std::filesystem::path studies = folders.source / "sim" / "studies";
  study::StudySettings settings;
  settings.scene = command.scene.empty() ? (studies / "sphere.toml").string() : command.scene;
  auto points = study::read_space(command.space.empty() ? studies / "small.toml"
                                                        : std::filesystem::path(command.space));
  if (!points) return report(points.error());
  settings.points = std::move(*points);
  settings.out = command.out;
  settings.threads =
      command.threads != 0 ? command.threads : std::max(1U, std::thread::hardware_concurrency());
  settings.folders = {folders.source, folders.cache()};
  Progress progress("study");
  settings.on_progress = [&](std::size_t done) {
    progress.show(fmt::format("{} of {} points", done, settings.points.size()));
  };
  const auto study = study::run_study(settings);
  progress.clear();
  if (!study) return report(study.error());
  const std::filesystem::path table = settings.out / "study.csv";
  if (Status written = write_file(table, study::to_csv(study->provenance, study->records)); !written)
    return report(written.error());
  fmt::print("{}: {} points, {} measured anew\n", table.string(), study->records.size(), study->measured);
  return 0;
}

}  // namespace

void add_study(CLI::App& app, const Folders& folders, int& exit_code) {
  const auto command = std::make_shared<StudyCommand>();
  CLI::App* study = app.add_subcommand("study", "measure accuracy against time over a space of designs");
  study->add_option("SCENE", command->scene, "a built-in scene, a TOML file or a mesh file (a grey sphere)");
  study->add_option("--space", command->space, "TOML file of the designs (sim/studies/small.toml)");
  study->add_option("--out", command->out, "folder for results")->capture_default_str();
  study->add_option("--threads", command->threads, "points at a time (0: all cores)")->capture_default_str();
  study->callback([&folders, &exit_code, command] { exit_code = run(folders, *command); });
}

}  // namespace halfway::cli

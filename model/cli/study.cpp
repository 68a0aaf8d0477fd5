// SPDX-License-Identifier: Apache-2.0
// `halfway study`: accuracy against time over a space of designs.
#include "study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <thread>

#include "cli/options.hpp"
#include "common/file.hpp"
#include "study/slurm.hpp"

namespace halfway::cli {
namespace {

constexpr std::size_t c_parts = 64;

struct StudyCommand {
  std::string scene, space;
  std::string out = "build/study";
  unsigned threads = 0;
  std::string executor = "local";
  std::string part;             ///< I/N
  std::size_t parts = c_parts;  ///< of a job array
  std::vector<std::string> slurm_options;
};

// Measures what is open in a job array; what is left to do then is to gather.
Status run_on_slurm(study::StudySettings settings, const Folders& folders, const StudyCommand& command) {
  settings.parts = std::clamp<std::size_t>(command.parts, 1, settings.points.size());
  auto open = study::open_parts(settings);
  if (!open) return open.error();
  const auto absolute = [](const std::filesystem::path& path) {
    return std::filesystem::absolute(path).lexically_normal().string();
  };
  study::JobArray array{
      .worker = {absolute(std::filesystem::read_symlink("/proc/self/exe")), "--source",
                 absolute(folders.source), "study", "--out", absolute(settings.out), "--threads", "1"},
      .parts = settings.parts,
      .open = std::move(*open),
      .folder = absolute(settings.out / "slurm"),
      .options = command.slurm_options};
  if (!command.space.empty()) {
    array.worker.emplace_back("--space");
    array.worker.push_back(absolute(command.space));
  }
  if (!command.scene.empty())
    array.worker.push_back(std::filesystem::exists(command.scene) ? absolute(command.scene) : command.scene);
  return study::run_job_array(array);
}

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
  if (!command.part.empty() &&
      (std::sscanf(command.part.c_str(), "%zu/%zu", &settings.part, &settings.parts) != 2 ||
       settings.part >= settings.parts))
    return report(bad_input("--part: '" + command.part + "' is no part; take I/N, I from 0 to N - 1"));
  if (command.executor != "local" && command.executor != "slurm")
    return report(bad_input("--executor: '" + command.executor + "' is no executor; take local or slurm"));
  if (command.executor == "slurm")
    if (const Status ran = run_on_slurm(settings, folders, command); !ran) return report(ran.error());
  Progress progress("study");
  settings.on_progress = [&](std::size_t done) {
    progress.show(fmt::format("{} of {} points", done, settings.points.size()));
  };
  const auto study = study::run_study(settings);
  progress.clear();
  if (!study) return report(study.error());
  if (!command.part.empty()) {
    fmt::print("part {}: {} points, {} measured anew\n", command.part, study->records.size(),
               study->measured);
    return 0;
  }
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
  study->add_option("--executor", command->executor, "local, or slurm: as a job array (sbatch)")
      ->capture_default_str();
  study->add_option("--parts", command->parts, "slurm: tasks of the array")->capture_default_str();
  study->add_option("--slurm-option", command->slurm_options,
                    "slurm: one more of sbatch's, such as --partition=short");
  study->add_option("--part", command->part, "I/N: measures this part of the points, and writes no table");
  study->callback([&folders, &exit_code, command] { exit_code = run(folders, *command); });
}

}  // namespace halfway::cli

// SPDX-License-Identifier: Apache-2.0
// `halfway study`: accuracy against time over a space of designs.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <shared_mutex>
#include <thread>

#include "sim/cli/options.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/file.hpp"
#include "sim/os/interruption.hpp"
#include "sim/os/must.hpp"
#include "sim/os/subprocess.hpp"
#include "sim/study/frame_time.hpp"
#include "sim/study/hardware.hpp"
#include "sim/study/host_setup.hpp"
#include "sim/study/measure.hpp"
#include "sim/study/query.hpp"
#include "sim/study/slurm.hpp"
#include "sim/study/study.hpp"
#include "sim/study/table.hpp"

namespace halfway::cli {
namespace {

constexpr std::size_t c_parts = 64;

// In the folder for results. A query does not change this table, because `halfway report` shows it.
constexpr const char* c_study_table = "study.csv";
constexpr const char* c_question_table = "question.csv";
constexpr const char* c_times_table = "times.csv";

struct StudyCommand {
  std::string scene, space;
  std::string size, tile;  ///< empty: those of the space
  std::string error, psnr, time;
  std::optional<double> clock_mhz;
  bool place = false;
  const synth::Family* family = &synth::c_default_family;
  std::string out = "build/study";
  unsigned threads = 0;
  std::string executor = "local";
  std::string part;             ///< I/N
  std::string set_up;           ///< a file with names of points
  std::size_t parts = c_parts;  ///< parts of a job array
  std::vector<std::string> slurm_options;
};

// The parsed and checked command.
struct StudyPlan {
  study::StudySettings settings;
  study::Demand demand;
  std::string space;
};

StudyPlan checked(const StudyCommand& command, const Folders& folders) {
  const std::filesystem::path studies = folders.source / "sim" / "study" / "spaces";
  StudyPlan plan;
  plan.demand = study::read_demand(command.error, command.psnr, command.time);
  if (command.clock_mhz && !(*command.clock_mhz > 0)) throw_bad_input("--clock: takes MHz above 0");
  const synth::Device& device = *command.family->device;
  if (command.place && (find_program("yosys").empty() || find_program(std::string(device.placer)).empty()))
    throw_tool_failed("--place: yosys or {} is not found; install both: {}", device.placer, device.install);
  if (command.parts == 0) throw_bad_input("--parts: takes 1 or more");
  study::StudySettings& settings = plan.settings;
  if (!command.part.empty() &&
      (std::sscanf(command.part.c_str(), "%zu/%zu", &settings.part, &settings.parts) != 2 ||
       settings.part >= settings.parts))
    throw_bad_input("--part: '{}' is not a part; take I/N, I from 0 to N - 1", command.part);
  settings.scene = command.scene.empty() ? (studies / "sphere.toml").string() : command.scene;
  settings.out = command.out;
  settings.family = command.family;
  settings.threads =
      command.threads != 0 ? command.threads : std::max(1U, std::thread::hardware_concurrency());
  settings.folders = {folders.source, folders.cache()};
  // A query is about the unchanged scene.
  plan.space = !command.space.empty()
                   ? command.space
                   : (studies / (plan.demand.any() ? "designs.toml" : "small.toml")).string();
  auto points = study::read_space(plan.space);
  if (!command.size.empty()) {
    const FrameSize size = checked_size(command.size);
    for (study::DesignPoint& point : points) point.size = size;
  }
  if (!command.tile.empty()) {
    const FrameSize tile = checked_size(command.tile, "--tile");
    if (std::min(tile.width, tile.height) < study::c_least_tile)
      throw_bad_input("--tile: {} is too small; width and height are {} pixels at least", command.tile,
                      study::c_least_tile);
    for (study::DesignPoint& point : points) point.tile = tile;
  }
  settings.points = study::ordered(std::move(points));
  return plan;
}

// Remove the points that cannot draw the scene. `place`: include placements as pieces.
void leave_out(study::StudySettings& settings, const std::string& space, bool place) {
  must(load_scene(settings.scene, settings.folders.source / "sim" / "scenes"));
  study::Drawable drawable = study::drawable(settings.points, settings.scene, settings.folders);
  settings.points = std::move(drawable.points);
  if (place) settings.placed = std::move(drawable.hardware);
  if (settings.points.empty())
    throw_bad_input("{}: no point of it can be drawn: {}", space, drawable.reasons.front());
  if (drawable.left_out > 0 && settings.parts == 1) {
    say(fmt::format("{} points are left out:", drawable.left_out));
    for (const std::string& reason : drawable.reasons) say("  " + reason);
  }
}

std::string absolute_path(const std::filesystem::path& path) {
  return std::filesystem::absolute(path).lexically_normal().string();
}

// The program with the arguments of all workers. They are the same on every machine.
std::vector<std::string> worker_of(const Folders& folders, const StudyCommand& command,
                                   const std::string& space) {
  std::vector<std::string> words = {absolute_path(std::filesystem::read_symlink("/proc/self/exe")),
                                    "--source",
                                    absolute_path(folders.source),
                                    "study",
                                    "--space",
                                    absolute_path(space)};
  if (!command.size.empty()) words.push_back("--size=" + command.size);
  if (!command.tile.empty()) words.push_back("--tile=" + command.tile);
  if (!command.scene.empty())
    words.push_back(std::filesystem::exists(command.scene) ? absolute_path(command.scene) : command.scene);
  return words;
}

// Make the init vectors of points; Callgrind counts the instructions.
void set_up(const study::StudySettings& settings, const std::string& names) {
  const std::filesystem::path scenes = settings.folders.source / "sim" / "scenes";
  // Load the scene once before all points, so that each point finds the same state of the process.
  must(load_scene(settings.scene, scenes));
  study::in_processes(names, [&](const std::string& name) {
    const auto point = std::ranges::find(settings.points, name, &study::DesignPoint::name);
    if (point == settings.points.end()) throw_bad_input("--set-up: '{}' is not a point of the space", name);
    const Scene scene = study::drawn_scene(settings.scene, scenes, *point);
    const auto hardware = study::drawing_hardware_of(*point, scene, settings.folders);
    study::set_up_frame(scene, point->size, hardware.key, study::frame_setup(*point, scene), hardware.models);
  });
}

// Measure all missing pieces in job arrays; the caller then assembles the points. In the first array, a task
// may end before other tasks have drawn the tiles that it should assemble. A second array assembles them.
void run_on_slurm(study::StudySettings settings, const Folders& folders, const StudyCommand& command,
                  const std::string& space) {
  settings.parts = std::clamp<std::size_t>(command.parts, 1, study::most_parts(settings));
  study::JobArray array{.worker = worker_of(folders, command, space),
                        .parts = settings.parts,
                        .options = command.slurm_options};
  for (const std::string& word :
       {std::string("--out"), absolute_path(settings.out), std::string("--threads=1")})
    array.worker.push_back(word);
  if (command.place)
    array.worker.insert(array.worker.end(),
                        {"--place", "--device=" + std::string(command.family->device->option)});
  const bool any_tiles = std::ranges::any_of(settings.points, &study::DesignPoint::in_tiles);
  const std::filesystem::path logs = settings.out / "slurm";
  std::vector<std::filesystem::path> rounds = {logs};
  if (any_tiles) rounds.push_back(logs / "gathering");
  for (const std::filesystem::path& folder : rounds) {
    array.open = study::open_parts(settings);
    array.folder = absolute_path(folder);
    study::run_job_array(array);
  }
}

// Say which clocks the times are of.
std::string clocks_text(const synth::Family& family, const study::HardwareTable& hardware) {
  const auto count = [&](std::string_view origin) {
    return std::ranges::count_if(hardware, [&](const auto& of) { return of.second.clock == origin; });
  };
  const auto stored = count(synth::c_stored), placed = count(synth::c_placed);
  return fmt::format("clocks on an {}: {} stored, {} placed, {} not known\n", family.device->title, stored,
                     placed, std::ssize(hardware) - stored - placed);
}

// Write the table. Print the answer for each picture, or without a demand the front of the main picture.
int conclude(const StudyPlan& plan, const study::Study& made, const study::HardwareTable& hardware,
             study::Clock clock) {
  const std::vector<study::Market> markets = study::markets_of(made.records, hardware, clock);
  const std::string csv = study::study_csv(made.provenance, made.records, hardware, markets);
  const std::filesystem::path table =
      plan.settings.out / (plan.demand.any() ? c_question_table : c_study_table);
  must(write_file(table, csv));
  const auto times = study::frame_times_of(made.records, hardware, clock);
  if (!plan.demand.any())
    must(write_file(plan.settings.out / c_times_table,
                    study::times_csv(made.provenance, made.records, times)));
  if (plan.demand.any() && markets.empty()) fmt::print("nothing meets it: none of the points is hardware\n");
  // Without a demand, print the front with the most hardware only.
  const auto main = std::ranges::max_element(markets, {}, [](const auto& m) { return m.offers.size(); });
  bool met = !markets.empty() || !plan.demand.any();
  for (auto market = markets.begin(); market != markets.end(); ++market) {
    const study::Answer answer = study::answer(market->offers, plan.demand);
    if (plan.demand.any() || market == main)
      fmt::print("{}", study::to_text(*market, answer, plan.demand, made.records));
    met = met && (!plan.demand.any() || answer.cheapest);
    const auto timed = std::ranges::find(times, market->picture, &study::PictureTimes::picture);
    if (timed != times.end() && (plan.demand.any() || market == main))
      fmt::print("{}", study::to_text(*timed, made.records));
  }
  fmt::print("{}: {} points, {} measured in this run\n{}", table.string(), made.records.size(), made.measured,
             clocks_text(*plan.settings.family, hardware));
  if (!plan.demand.any()) fmt::print("make report draws it\n");
  return static_cast<int>(met ? ExitCode::equal : ExitCode::differs);
}

int run(const Folders& folders, const StudyCommand& command) {
  StudyPlan plan = checked(command, folders);
  study::StudySettings& settings = plan.settings;
  if (!command.set_up.empty()) {
    set_up(settings, command.set_up);
    return 0;
  }
  settings.set_up = worker_of(folders, command, plan.space);
  settings.host_times = command.part.empty();
  const bool on_slurm = command.executor == "slurm";
  // A run without parts places after the measurement, when it is known which hardware can fit; this saves
  // synthesis.
  leave_out(settings, plan.space, command.place && (on_slurm || !command.part.empty()));
  if (on_slurm) run_on_slurm(settings, folders, command, plan.space);
  Progress progress("study");
  settings.on_progress = [&](const std::string& text) { progress.show(text); };
  std::optional<Interruption> interruption;
  if (command.part.empty())
    interruption.emplace([&] {
      say(fmt::format("\ninterrupted; finished measurements are kept in {}; the same command continues there",
                      (settings.out / "points").string()));
    });
  // Work that a signal interrupts must not be reported as an error: after a signal the gate stays closed.
  std::shared_lock<std::shared_timed_mutex> writing;
  const auto finished = [&](const auto& work) {
    auto made = caught(work);
    if (interruption) writing = interruption->writing();
    progress.clear();
    return must(std::move(made));
  };
  const study::Study study = finished([&] { return study::run_study(settings); });
  if (writing) writing.unlock();
  if (!command.part.empty()) {
    fmt::print("part {}: {} points, {} measured in this run, {} tiles drawn, {} placements\n", command.part,
               study.records.size(), study.measured, study.drawn_tiles, study.placements);
    return 0;
  }
  const study::HardwareTable hardware = finished([&] {
    return study::hardware_figures(settings.scene, study.records, settings.folders,
                                   {.threads = settings.threads,
                                    .place = command.place,
                                    .family = command.family,
                                    .on_progress = settings.on_progress});
  });
  return conclude(plan, study, hardware, command.clock_mhz);
}

}  // namespace

void add_study(CLI::App& app, const Folders& folders, int& exit_code) {
  const auto command = std::make_shared<StudyCommand>();
  CLI::App* study = app.add_subcommand("study", "measure accuracy and time over a space of designs");
  study->add_option("SCENE", command->scene, "a built-in scene, a TOML file or a mesh file (a grey sphere)");
  study->add_option("--space", command->space,
                    "TOML file of the designs (sim/study/spaces/small.toml; for a query designs.toml)");
  study->add_option("--size", command->size, "WIDTHxHEIGHT, of every point (the space's)");
  study->add_option("--tile", command->tile,
                    "WIDTHxHEIGHT: larger frames are drawn in tiles of this size (the space's, or 1280x960)");
  study->add_option("--error", command->error,
                    "query: the cheapest hardware with at most this largest error, in steps of 1/255");
  study->add_option("--psnr", command->psnr, "query: at least this PSNR, in dB");
  study->add_option("--time", command->time, "query: a frame in at most this time, such as 10ms");
  study->add_option("--clock", command->clock_mhz, "clock in MHz assumed for hardware without a known clock");
  study->add_flag("--place", command->place,
                  "place and route hardware without a known clock: minutes for each design");
  add_device(*study, command->family);
  study
      ->add_option("--out", command->out,
                   fmt::format("folder for results: the table {}, of a query {}, and points/", c_study_table,
                               c_question_table))
      ->capture_default_str();
  study->add_option("--threads", command->threads, "points at a time (0: all cores)")->capture_default_str();
  study->add_option("--executor", command->executor, "local, or slurm: as a job array (sbatch)")
      ->check(CLI::IsMember({"local", "slurm"}))
      ->capture_default_str();
  study->add_option("--parts", command->parts, "slurm: tasks of the array")->capture_default_str();
  study->add_option("--slurm-option", command->slurm_options,
                    "slurm: an additional option of sbatch, such as --partition=short");
  study->add_option(
      "--part", command->part,
      "I/N: measure only this part of the points (with --place: and of the placements); no table");
  study->add_option("--set-up", command->set_up,
                    "a file with names of points: only make their init vectors, for counting instructions");
  study->callback([&folders, &exit_code, command] { exit_code = run(folders, *command); });
}

}  // namespace halfway::cli

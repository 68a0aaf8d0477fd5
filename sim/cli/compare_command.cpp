// SPDX-License-Identifier: Apache-2.0
// `halfway compare`: compares the stored traces and frames of `halfway sim` again.
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "frame/metrics.hpp"
#include "sim/cli/options.hpp"
#include "sim/driver/stream_comparator.hpp"
#include "sim/files/image.hpp"
#include "sim/files/trace.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/run/result_files.hpp"
#include "sim/run/simulate.hpp"

namespace halfway::cli {
namespace {

struct CompareCommand {
  std::string shader = "quadratic";
  bool all_effects = false;
  std::string out = "build/out";
  std::vector<std::string> scenes;
};

// Feed two traces to a comparator. Return the name of the hardware key.
std::string compare_traces(const std::filesystem::path& golden_path, const std::filesystem::path& rtl_path,
                           StreamComparator& comparator) {
  auto golden = must(TraceReader::open(golden_path, {}));
  auto rtl = must(TraceReader::open(rtl_path, golden.key_name()));
  must(read_side_by_side(golden, rtl, [&](auto expected, auto drawn) { comparator.add(expected, drawn); }));
  comparator.finish();
  return golden.key_name();
}

// Contents of a run's summary, which is the last file written.
struct LeftSummary {
  std::map<std::string, std::string> faults;  ///< by simulator; "": no fault
  std::uint64_t in_view = 0;                  ///< number of triangles
  std::uint64_t reference_pixels = 0;         ///< pixels covered by the reference or the golden model
};

LeftSummary read_summary(const std::filesystem::path& summary) {
  const auto text = must(read_file(summary));
  LeftSummary left;
  try {
    const auto json = nlohmann::json::parse(text);
    for (const auto& run : json.at("runs"))
      left.faults[run.at("simulator").get<std::string>()] = run.value("fault", "");
    const auto& setup = json.at("setup");
    left.in_view = setup.at("on_screen").get<std::uint64_t>() + setup.at("degenerate").get<std::uint64_t>();
    left.reference_pixels = json.at("accuracy").at("pixels").get<std::uint64_t>();
  } catch (const nlohmann::json::exception& error) {
    throw_bad_input("{}: not a summary: {}", summary.string(), error.what());
  }
  return left;
}

// The command that makes the results again.
std::string make_sim(const std::string& scene, const CompareCommand& command) {
  std::string text = "make sim SCENE=" + scene;
  if (command.shader != CompareCommand{}.shader) text += " SHADER=" + command.shader;
  if (command.all_effects) text += " ALL_EFFECTS=1";
  if (command.out != CompareCommand{}.out) text += " OUT=" + command.out;
  return text;
}

// Compare all results of a scene. False if something differs or nothing was drawn.
bool compare_scene(const std::string& scene, const CompareCommand& command, Shader shader) {
  if (const std::string name = result_name(scene); name.empty() || name == "." || name == "..")
    throw_bad_input("'{}' is not the name of a scene", scene);
  const ResultFiles files = ResultFiles::of(command.out, result_name(scene),
                                            {.shader = shader, .all_effects = command.all_effects});
  const auto none = [&](const std::string& what) {
    return Failure{bad_input(
        fmt::format("{}: {}; run `{}` first", files.folder.string(), what, make_sim(scene, command)))};
  };
  std::error_code error;
  if (!std::filesystem::is_directory(files.folder, error)) throw none("no results here");
  const auto lock = must(lock_folder(files.folder, [&] { say_waiting(files.folder); }));
  if (!std::filesystem::exists(files.summary(), error))
    throw none("the run was interrupted, or has not reached this scene yet");
  const auto left = read_summary(files.summary());

  bool equal = true;
  std::uint64_t compared = 0;  // number of fragments
  for (const std::string simulator : {"ghdl", "verilator", "lanes"}) {
    const auto fault = left.faults.find(simulator);
    if (fault == left.faults.end()) {
      if (simulator == "lanes") continue;
      fmt::print("{:<12} {:<10} not compared: it was not run\n", result_name(scene), simulator);
      continue;
    }
    if (!fault->second.empty()) {
      fmt::print("{:<12} {:<10} differs, as sim found: {}\n", result_name(scene), simulator, fault->second);
      equal = false;
      continue;
    }
    if (!std::filesystem::exists(files.trace(simulator), error)) throw none(simulator + ".trace is gone");
    StreamComparator comparator;
    const auto key = compare_traces(files.trace("golden"), files.trace(simulator), comparator);
    const Frame golden = must(read_png(files.frame("golden"))), rtl = must(read_png(files.frame(simulator)));
    const FrameDistance distance = must(frame_distance(golden, rtl));
    equal = equal && comparator.mismatches() == 0 && distance.differing == 0;
    compared += comparator.golden_count();
    const std::string mismatches = comparator.golden_count() == 0 && comparator.mismatches() == 0
                                       ? "nothing compared"
                                       : fmt::format("{} mismatches", comparator.mismatches());
    fmt::print("{:<12} {:<10} {} {}x{} {:>9} fragments, {}; frame: {} of {} pixels differ\n",
               result_name(scene), simulator, key, golden.size.width, golden.size.height,
               comparator.golden_count(), mismatches, distance.differing, distance.pixels);
    if (comparator.mismatches() != 0) fmt::print(stderr, "{}", comparator.describe(simulator));
  }
  if (!equal) return false;
  const auto nothing = left.faults.empty()
                           ? "nothing was compared: no simulator drew; run `" + make_sim(scene, command) + "`"
                           : nothing_compared(compared, left.in_view, left.reference_pixels);
  if (nothing) say(fmt::format("{}: {}", result_name(scene), *nothing));
  return !nothing;
}

int run(const Folders& folders, const CompareCommand& command) {
  const auto shader = checked_shader(command.shader);
  std::vector<std::string> scenes = command.scenes;
  if (scenes.empty()) scenes = builtin_scenes(folders);
  bool equal = true;
  for (const std::string& scene : scenes) equal = compare_scene(scene, command, shader) && equal;
  return static_cast<int>(equal ? ExitCode::equal : ExitCode::differs);
}

}  // namespace

void add_compare(CLI::App& app, const Folders& folders, int& exit_code) {
  CLI::App* sub = app.add_subcommand(
      "compare", "compare the results of sim: traces field by field, frames pixel by pixel");
  auto command = std::make_shared<CompareCommand>();
  sub->add_option("scene", command->scenes, "as for sim (default: all built-in scenes)");
  sub->add_option("--shader", command->shader, c_shader_names)->capture_default_str();
  sub->add_flag("--all-effects", command->all_effects, "the results of sim --all-effects");
  sub->add_option("--out", command->out, "folder of results")->capture_default_str();
  sub->callback([=, &folders, &exit_code] { exit_code = run(folders, *command); });
}

}  // namespace halfway::cli

// SPDX-License-Identifier: Apache-2.0
// `halfway compare`: the traces and frames that `halfway sim` left, compared once more.
#include <fmt/format.h>

#include <filesystem>

#include "cli/options.hpp"
#include "frame/image.hpp"
#include "frame/metrics.hpp"
#include "frame/trace.hpp"
#include "run/result_files.hpp"
#include "run/stream_comparator.hpp"
#include "run/trace_pair.hpp"

namespace halfway::cli {
namespace {

struct CompareCommand {
  std::string shader = "quadratic";
  bool all_effects = false;
  std::string out = "build/out";
  std::vector<std::string> scenes;
};

// Feeds a comparator from two traces; gives the hardware key's name.
Result<std::string> compare_traces(const std::filesystem::path& golden_path,
                                   const std::filesystem::path& rtl_path, StreamComparator& comparator) {
  auto golden = TraceReader::open(golden_path, {});
  if (!golden) return golden.error();
  auto rtl = TraceReader::open(rtl_path, golden->key_name());
  if (!rtl) return rtl.error();
  if (const Status status = read_side_by_side(
          *golden, &*rtl, [&](auto fragments) { comparator.add_golden(fragments); },
          [&](auto fragments) { comparator.add_rtl(fragments); });
      !status)
    return status.error();
  comparator.finish();
  return golden->key_name();
}

int run(const Folders& folders, const CompareCommand& command) {
  std::vector<std::string> scenes = command.scenes;
  if (scenes.empty()) {
    auto builtin = builtin_scenes(folders);
    if (!builtin) return report(builtin.error());
    scenes = std::move(*builtin);
  }
  bool equal = true;
  for (const std::string& scene : scenes) {
    const ResultFiles files =
        ResultFiles::of(command.out, result_name(scene), command.shader, command.all_effects);
    std::error_code error;
    if (!std::filesystem::exists(files.trace("golden"), error))
      return report(bad_input(
          fmt::format("{}: no results here; run `make sim SCENE={}` first", files.folder.string(), scene)));
    bool any = false;
    for (const char* simulator : {"ghdl", "verilator"}) {
      if (!std::filesystem::exists(files.trace(simulator), error)) continue;
      any = true;
      StreamComparator comparator;
      const auto key = compare_traces(files.trace("golden"), files.trace(simulator), comparator);
      if (!key) return report(key.error());
      const auto golden = read_png(files.frame("golden")), rtl = read_png(files.frame(simulator));
      if (!golden) return report(golden.error());
      if (!rtl) return report(rtl.error());
      const auto distance = frame_distance(*golden, *rtl);
      if (!distance) return report(distance.error());
      const bool same = comparator.mismatches() == 0 && distance->differing == 0;
      equal = equal && same;
      fmt::print("{:<12} {:<10} {} {}x{} {:>9} fragments, {} mismatches; frame: {} of {} pixels differ\n",
                 result_name(scene), simulator, *key, golden->size.width, golden->size.height,
                 comparator.golden_count(), comparator.mismatches(), distance->differing, distance->pixels);
      if (comparator.mismatches() != 0) fmt::print(stderr, "{}", comparator.describe(simulator));
    }
    if (!any)
      return report(bad_input(fmt::format("{}: no trace of a simulator here; run `make sim SCENE={}` first",
                                          files.folder.string(), scene)));
  }
  return static_cast<int>(equal ? ExitCode::equal : ExitCode::differs);
}

}  // namespace

void add_compare(CLI::App& app, const Folders& folders, int& exit_code) {
  CLI::App* sub =
      app.add_subcommand("compare", "compare what sim left: traces field by field, frames pixel by pixel");
  auto command = std::make_shared<CompareCommand>();
  sub->add_option("scene", command->scenes, "as for sim; none: all built-in scenes");
  sub->add_option("--shader", command->shader, "quadratic")->capture_default_str();
  sub->add_flag("--all-effects", command->all_effects, "what sim --all-effects left");
  sub->add_option("--out", command->out, "folder of results")->capture_default_str();
  sub->callback([=, &folders, &exit_code] { exit_code = run(folders, *command); });
}

}  // namespace halfway::cli

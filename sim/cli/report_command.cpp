// SPDX-License-Identifier: Apache-2.0
// `halfway report`: one HTML page with the results of all other commands.
#include <fmt/format.h>

#include "sim/cli/options.hpp"
#include "sim/os/csv.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/page_part.hpp"
#include "sim/report/front_plot.hpp"
#include "sim/report/report.hpp"
#include "sim/report/times.hpp"

namespace halfway::cli {
namespace {

struct ReportCommand {
  std::string out = "build/report/index.html";
  std::string results = "build/out", study = "build/study";
  std::optional<std::string> figures;  ///< std::nullopt: those of the last make figures, or the checkout's
  bool no_timing = false;
  std::string front;   ///< write the front to this folder, and no page
  std::string times;   ///< write the times of frames to this folder, and no page
  std::string page;    ///< with `front` or `times`: also write the part of that name of this page
  std::string readme;  ///< with `times`: also write the short form of that part of this page
};

template <class Text>
void write_part(const std::string& file, const char* part, const Text& text) {
  if (!file.empty())
    must(rewrite_page(file, [&](const std::string& page) { return with_page_part(page, part, text()); }));
}

void write_front(const ReportCommand& command) {
  const Table study = must(read_csv(std::filesystem::path(command.study) / "study.csv"));
  const TemporaryFolder scratch = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
  const std::size_t designs = report::write_front(study, command.front, scratch.path());
  if (designs == 0)
    throw_bad_input("{}: no design in it has both a cost and an error; make study", command.study);
  write_part(command.page, "front", [&] { return report::page_front(report::front_of(study)); });
  fmt::print("{}: the front of {} designs\n", (std::filesystem::path(command.front) / "front.svg").string(),
             designs);
}

void write_times(const ReportCommand& command) {
  const Table times = must(read_csv(std::filesystem::path(command.study) / "times.csv"));
  const TemporaryFolder scratch = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
  const std::size_t designs = report::write_times(times, command.times, scratch.path());
  write_part(command.page, "times", [&] { return report::page_times(times); });
  write_part(command.readme, "times", [&] { return report::readme_times(times); });
  fmt::print("{}: the times of {} designs\n", (std::filesystem::path(command.times) / "times.csv").string(),
             designs);
}

void run(const Folders& folders, const ReportCommand& command) {
  if (!command.front.empty()) return write_front(command);
  if (!command.times.empty()) return write_times(command);
  std::filesystem::path figures = command.figures.value_or("build/figures");
  if (!command.figures && !std::filesystem::exists(figures / "figures.json"))
    figures = folders.source / "docs/results/figures";
  Progress progress("report");
  const report::Report made =
      report::write_report({.page = command.out,
                            .results = command.results,
                            .study = command.study,
                            .figures = figures,
                            .folders = {folders.source, folders.cache()},
                            .scenes = builtin_scenes(folders),
                            .timing = !command.no_timing,
                            .on_progress = [&](const std::string& what) { progress.show(what); }});
  progress.clear();
  for (const std::string& note : made.notes) say(note);
  fmt::print("{}: {} frames, {} points, {} figures, {:.1f} MB\n", command.out, made.frames, made.points,
             made.figures, static_cast<double>(made.bytes) / 1e6);
}

}  // namespace

void add_report(CLI::App& app, const Folders& folders, int&) {
  const auto command = std::make_shared<ReportCommand>();
  CLI::App* sub = app.add_subcommand("report", "write one HTML page with the results of the other commands");
  sub->add_option("--out", command->out, "file to write")->capture_default_str();
  sub->add_option("--results", command->results, "results of sim")->capture_default_str();
  sub->add_option("--study", command->study, "results of study")->capture_default_str();
  sub->add_option("--figures", command->figures,
                  "results of figures (build/figures, otherwise docs/results/figures)");
  sub->add_flag("--no-timing", command->no_timing, "omit the timing diagrams, which need GHDL");
  sub->add_option(
      "--front", command->front,
      "write front.svg and front.csv, a study's error against cells, to this folder, and no page");
  sub->add_option("--times", command->times,
                  "write times.csv and its plots, a study's error against the time of a frame, to this "
                  "folder, and no page");
  sub->add_option("--page", command->page,
                  "with --front or --times: a page whose part \"front\" or \"times\" is written");
  sub->add_option("--readme", command->readme,
                  "with --times: a page whose part \"times\" is written, in a short form");
  sub->callback([&folders, command] { run(folders, *command); });
}

}  // namespace halfway::cli

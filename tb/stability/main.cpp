// SPDX-License-Identifier: Apache-2.0
// halfway_stability: tries every hard case of the registry in the specification, in the golden model and in
// the RTL.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "cli/program.hpp"
#include "common/seconds.hpp"
#include "common/threads.hpp"
#include "stability/hard_case.hpp"
#include "stability/page.hpp"
#include "stability/trial.hpp"

namespace halfway::stability {
namespace {

constexpr const Family* c_families[] = {&c_edges,   &c_quadratic,    &c_spherical,  &c_processors,
                                        &c_shadows, &c_illumination, &c_arithmetic, &c_conversions};

constexpr std::string_view c_table =
    "| case | breaks | remedy | holds | published | ours | figures | fragments in golden, RTL |\n"
    "| --- | --- | --- | --- | --- | --- | --- | --- |\n";

struct Options {
  bool quick = false;
  std::filesystem::path page{}, source{};
  std::string part{};
};

struct Job {
  const Family* family;
  const HardCase* hard_case;
};

struct Outcome {
  std::string failure;  ///< empty: the property holds
  bool broken = false;  ///< a tool was missing or broke, as `failure` says
  std::string row;      ///< of the page
};

std::string past(const Worst& worst, const HardCase& c) {
  return fmt::format("{:.4g} of {:.4g} {} at {}", worst.figure, worst.bound, c.unit, worst.where);
}

std::string failure_of(const HardCase& c, const Trial& trial) {
  if (!trial.failure().empty()) return trial.failure();
  const Worst &ours = trial.ours(), &published = trial.published();
  if (ours.count == 0) return "has no figure";
  if (!ours.within()) return past(ours, c);
  switch (c.published) {
    case Published::breaks:
      if (published.count == 0) return "has no figure of the published form";
      if (published.within()) return "the published form does not break: " + past(published, c);
      break;
    case Published::holds:
      if (published.count == 0) return "has no figure of the published form";
      if (!published.within()) return "published: " + past(published, c);
      break;
    case Published::silent:
      if (published.count > 0) return "has a figure of the published form, and says it had none";
      break;
  }
  return "";
}

std::string row_of(const HardCase& c, const Trial& trial) {
  const auto figure = [](const Worst& worst) { return fmt::format("{:.3g}", worst.figure); };
  return fmt::format("| {} | {} | {} | {} | {} | {} of {:.3g} {} | {} | {}, {} |\n", c.name, c.breaks,
                     c.remedy, c.holds, c.published == Published::silent ? "–" : figure(trial.published()),
                     figure(trial.ours()), trial.ours().bound, c.unit,
                     trial.ours().count + trial.published().count, trial.golden_fragments(),
                     trial.rtl_fragments());
}

Outcome run(const Job& job, Simulators& rtl, const Options& options) {
  Trial trial({options.source, options.source / "build" / "cache"}, rtl, options.quick);
  job.hard_case->run(trial);
  if (!trial.tools()) return {trial.tools().error().message, true, ""};
  return {failure_of(*job.hard_case, trial), false, row_of(*job.hard_case, trial)};
}

ExitCode run_all(const std::vector<Job>& jobs, const Options& options) {
  std::vector<Outcome> outcomes(jobs.size());
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::size_t done = 0, failed = 0, broken = 0;
  const bool terminal = isatty(STDERR_FILENO);
  const auto work = [&] {
    Simulators rtl;
    for (std::size_t at; (at = next++) < jobs.size();) {
      const auto began = std::chrono::steady_clock::now();
      outcomes[at] = run(jobs[at], rtl, options);
      const double seconds = seconds_since(began);
      const std::lock_guard lock(mutex);
      const Outcome& outcome = outcomes[at];
      broken += outcome.broken;
      failed += !outcome.broken && !outcome.failure.empty();
      fmt::print("{}: {}: {} ({:.1f} s)\n", jobs[at].family->name, jobs[at].hard_case->name,
                 outcome.failure.empty() ? "holds"
                 : outcome.broken        ? outcome.failure
                                         : "FAILS: " + outcome.failure,
                 seconds);
      std::fflush(stdout);
      if (terminal) fmt::print(stderr, "{} of {}\r", ++done, jobs.size());
    }
  };
  work_on_threads(options.quick ? 1 : std::max(1U, std::thread::hardware_concurrency()), work);
  fmt::print("{} of {} cases fail, {} could not be run\n", failed, jobs.size(), broken);
  if (broken > 0) return ExitCode::tool_failed;
  if (failed > 0) return ExitCode::differs;
  if (options.page.empty()) return ExitCode::equal;
  std::vector<Section> sections;
  const Family* family = nullptr;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (jobs[i].family != family) {
      family = jobs[i].family;
      sections.push_back({std::string(family->name), std::string(c_table)});
    }
    sections.back().body += outcomes[i].row;
  }
  const auto written = write_sections(options.page, sections);
  if (written) return ExitCode::equal;
  fmt::print(stderr, "{}\n", written.error().message);
  return written.error().code;
}

int main_of(const Options& options) {
  std::vector<Job> jobs;
  for (const Family* family : c_families)
    for (const HardCase& c : family->cases)
      if (family->name.find(options.part) != std::string_view::npos ||
          (options.page.empty() && c.name.find(options.part) != std::string_view::npos))
        jobs.push_back({family, &c});
  if (jobs.empty()) {
    fmt::print(stderr, "{}: no family and no case has a name like this\n", options.part);
    return static_cast<int>(ExitCode::bad_input);
  }
  return static_cast<int>(run_all(jobs, options));
}

}  // namespace
}  // namespace halfway::stability

int main(int argc, char** argv) {
  using namespace halfway;
  stability::Options options;
  CLI::App app{"Tries hard cases in the specification, in the golden model and in the RTL",
               "halfway_stability"};
  app.add_flag("--quick", options.quick, "a short sweep of each");
  app.add_option("--page", options.page, "file in which the families' sections are written anew");
  app.add_option("SOURCE", options.source, "the project's root")->required();
  app.add_option("PART", options.part,
                 "only families whose names hold it, or, without --page, cases whose names do");
  int exit_code = 0;
  app.callback([&] {
    options.source = std::filesystem::absolute(options.source);
    exit_code = stability::main_of(options);
  });
  return cli::run_program(app, argc, argv, exit_code);
}

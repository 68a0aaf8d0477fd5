// SPDX-License-Identifier: Apache-2.0
// Whole programs as a user runs them: `make sim` and `halfway view`.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <regex>

#include "sim/extras/bench/measurements.hpp"
#include "sim/os/seconds.hpp"
#include "sim/os/subprocess.hpp"

namespace halfway {
namespace {

std::size_t cached_builds() {
  std::size_t count = 0;
  for (const auto& kind : std::filesystem::directory_iterator(c_folders.cache))
    if (kind.is_directory())
      for ([[maybe_unused]] const auto& build : std::filesystem::directory_iterator(kind)) ++count;
  return count;
}

// The command's output; throws if it fails.
std::string output_of(const Command& command) {
  const ProcessEnd end = must(run_process(command, "apt-get install make cmake"));
  if (!end.succeeded()) throw_tool_failed("{} failed: {}", fmt::join(command.arguments, " "), end.output);
  return end.output;
}

}  // namespace

void measure_make(Json& speed) {
  const Command sim{.arguments = {"make", "sim", "SCENE=spheres", "OUT=" + (c_scratch / "out").string()},
                    .working_folder = c_source,
                    .environment = {{"MAKEFLAGS", ""}, {"SHADER", ""}, {"SIZE", ""}}};
  double seconds = std::numeric_limits<double>::infinity(), processor = seconds;
  std::string line;
  bool rebuilt = false;
  std::size_t builds = 0;
  for (int i = 0; i < 4; ++i) {  // the first run may build
    const double before = children_seconds();
    const auto start = std::chrono::steady_clock::now();
    const std::string output = output_of(sim);
    const double took = seconds_since(start);
    fmt::print(stderr, "make sim: {:.2f} s\n", took);
    if (i != 0) {
      seconds = std::min(seconds, took);
      processor = std::min(processor, children_seconds() - before);
      rebuilt = rebuilt || cached_builds() != builds;
    }
    builds = cached_builds();
    line = output.substr(std::min(output.find("spheres  "), output.size()));
    line = line.substr(0, line.find('\n'));
  }
  const std::string build =
      output_of({.arguments = {"cmake", "--build", (c_source / "build").string(), "--target", "halfway"}});
  if (rebuilt || build.find("no work to do") == std::string::npos)
    throw Failure{{ExitCode::differs, "make sim builds something in an unchanged tree"}};
  speed["make_sim"] = {{"seconds", fmt::format("{:.2f}", seconds)},
                       {"processor", fmt::format("{:.2f}", processor)},
                       {"line", line}};
}

void measure_view(Json& speed) {
  struct View {
    const char *shader, *what;
    std::vector<std::string> options;
    double slowest = std::numeric_limits<double>::infinity(), fastest = 0.0;  // frames per second
    std::string parts{};
  };
  std::vector<View> views = {
      {"quadratic", "PNG, compared", {}},
      {"quadratic", "PPM, compared", {"--format", "ppm"}},
      {"quadratic", "PPM, `--no-compare`", {"--format", "ppm", "--no-compare"}},
      {"quadratic", "PPM, compared, `--simulator lanes`", {"--format", "ppm", "--simulator", "lanes"}},
      {"spherical", "PNG, compared", {}},
      {"spherical", "PPM, compared, `--simulator lanes`", {"--format", "ppm", "--simulator", "lanes"}},
  };
  const std::regex line(R"(\| ([0-9.]+) frames a second,[^\n]*\nprocessor time a frame: ([^\n]*))");
  for (int repetition = 0; repetition < 4; ++repetition)  // the first run may build
    for (View& view : views) {
      Command command{.arguments = {(c_source / "build/halfway").string(), "view", "spheres", "--shader",
                                    view.shader, "--size", "1000x1000", "--frames", "36", "--threads", "2",
                                    "--out", (c_scratch / "view").string()},
                      .working_folder = c_source};
      command.arguments.insert(command.arguments.end(), view.options.begin(), view.options.end());
      const std::string output = output_of(command);
      std::smatch found;
      if (!std::regex_search(output, found, line)) throw_tool_failed("halfway view said: {}", output);
      if (repetition == 0) continue;
      const double rate = std::stod(found[1]);
      fmt::print(stderr, "view, {}, {}: {:.1f} frames a second\n", view.shader, view.what, rate);
      view.slowest = std::min(view.slowest, rate);
      view.fastest = std::max(view.fastest, rate);
      view.parts = std::regex_replace(found.str(2), std::regex(" ms"), "");
    }
  speed["view"] = {{"rows", Json::array()}};
  for (const View& view : views)
    speed["view"]["rows"].push_back(
        {view.shader, view.what, fmt::format("{:.0f} to {:.0f}", view.slowest, view.fastest), view.parts});
}

}  // namespace halfway

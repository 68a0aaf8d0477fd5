// SPDX-License-Identifier: Apache-2.0
// halfway_bench [--page FILE] [--jobs N] [--only SECTION…]: measures speed as ratios within one run. It
// compares all ways to draw a picture with the project's own; whole frames; frames in a browser; small
// triangles; and whole runs of `make sim` and `halfway view`. --page writes the page. Times are processor
// times: the median of several repetitions in random order, scaled to the best speed of the run. Absolute
// times are valid only for the machine that prints them.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <thread>

#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/extras/bench/measurements.hpp"
#include "sim/files/template.hpp"
#include "sim/os/command_line.hpp"
#include "sim/os/file.hpp"
#include "sim/os/machine.hpp"
#include "sim/os/subprocess.hpp"

namespace halfway {
namespace {

struct Options {
  std::filesystem::path page{};
  unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::string> only{};
};

std::string first_line(const std::vector<std::string>& question) {
  if (find_program(question.front()).empty()) return "not here";
  const auto end = run_process({.arguments = question}, "");
  return end ? end->output.substr(0, end->output.find('\n')) : "not here";
}

/// Number of runnable processes: averages over the last 1, 5 and 15 minutes.
std::array<double, 3> load() {
  std::array<double, 3> minutes{};
  if (::getloadavg(minutes.data(), 3) != 3) return {};
  return minutes;
}

void run(const Options& options) {
  must(make_folders(c_scratch));
  const auto text = [](double value) { return fmt::format("{:.1f}", value); };
  Json speed = {{"machine", machine()},
                {"load", {{"before", text(load()[0])}}},
                {"rtl", must(rtl_hash(c_source))},
                {"tools",
                 {{"ghdl", first_line({"ghdl", "--version"})},
                  {"verilator", first_line({"verilator", "--version"})},
                  {"clang", first_line({"clang++", "--version"})},
                  {"gcc", first_line({"g++", "--version"})}}}};
  const std::pair<const char*, std::function<void()>> sections[] = {
      {"make_sim", [&] { measure_make(speed); }},
      {"ways", [&] { measure_ways(speed, options.jobs); }},
      {"whole_frames", [&] { measure_whole_frames(speed); }},
      {"browser", [&] { measure_browser(speed); }},
      {"small_triangles", [&] { measure_small_triangles(speed); }},
      {"view", [&] { measure_view(speed); }}};
  for (const auto& [name, measure] : sections) {
    speed[name] = false;
    if (options.only.empty() || std::ranges::find(options.only, name) != options.only.end()) measure();
  }
  speed["load"]["after"] = text(load()[0]);
  speed["load"]["long"] = text(load()[2]);

  const std::string page = must(filled_template(c_source / "sim/extras/bench/speed.md.mustache", speed));
  fmt::print("\n{}", page);
  if (!options.page.empty()) must(write_file(options.page, page));
}

}  // namespace
}  // namespace halfway

int main(int argc, char** argv) {
  using namespace halfway;
  Options options;
  CLI::App app{"Measures speed, as ratios within one run", "halfway_bench"};
  auto* page = app.add_option("--page", options.page, "page that is written; needs all sections");
  app.add_option("--jobs", options.jobs, "builds at a time")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("--only", options.only,
                 "some sections: ways, whole_frames, browser, small_triangles, make_sim, view")
      ->excludes(page);
  app.callback([&] { run(options); });
  return cli::run_program(app, argc, argv, 0);
}

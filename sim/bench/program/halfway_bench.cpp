// SPDX-License-Identifier: Apache-2.0
// halfway_bench [--page FILE] [--jobs N] [--benchmark_…]: measures speed as ratios within one run. It
// compares all ways to draw a picture with the project's own; growth of time and memory with triangles,
// pixels and lights; whole frames; small triangles; cores; and whole runs of `make sim`. --page writes the
// page. Times are processor times: the median of several repetitions in random order, scaled to the best
// speed of the run. Absolute times are valid only for the machine that prints them.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <thread>

#include "sim/bench/program/bench.hpp"
#include "sim/bench/ways.hpp"
#include "sim/ghdl/rtl_hash.hpp"
#include "sim/pages/template.hpp"
#include "sim/program/program.hpp"
#include "sim/system/file.hpp"
#include "sim/system/machine.hpp"
#include "sim/system/subprocess.hpp"

namespace halfway {
namespace {

struct Options {
  std::filesystem::path page{};
  unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
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

int run(const Options& options) {
  must(make_folders(c_scratch));
  const auto text = [](double value) { return fmt::format("{:.1f}", value); };
  Json speed = {
      {"machine", machine()},
      {"load", {{"before", text(load()[0])}}},
      {"rtl", must(rtl_hash(c_source))},
      {"tools",
       {{"ghdl", first_line({"ghdl", "--version"})},
        {"mcode", lacking(Way::ghdl_mcode, c_folders).empty() ? "mcode back ends" : "no mcode back end"},
        {"verilator", first_line({"verilator", "--version"})},
        {"clang", first_line({"clang++", "--version"})},
        {"gcc", first_line({"g++", "--version"})},
        {"yosys", first_line({"yosys", "-V"})}}}};
  Measurements measurements;
  const WayTable ways(measurements, options.jobs);
  const Growth growth(measurements, options.jobs);
  measurements.run();

  ways.write(speed);
  growth.write(speed);
  speed["small_triangles"] = Json::array();
  speed["cores"] = Json::array();
  speed["whole_frames"] = speed["browser"] = speed["make_sim"] = speed["views"] = false;
  if (is_wanted("whole_frames")) measure_whole_frames(speed);
  if (is_wanted("browser")) measure_browser(speed);
  if (is_wanted("small_triangles")) measure_small_triangles(speed);
  ways.write_cores(speed);
  const bool unchanged = !is_wanted("make_sim") || measure_make(speed);
  if (is_wanted("view")) measure_view(speed);
  speed["load"]["after"] = text(load()[0]);
  speed["load"]["long"] = text(load()[2]);

  const std::string page = must(filled_template(c_source / "sim/bench/page.md.mustache", speed));
  fmt::print("\n{}", page);
  if (!options.page.empty()) must(write_file(options.page, page));
  return unchanged ? 0 : 1;
}

}  // namespace
}  // namespace halfway

int main(int argc, char** argv) {
  using namespace halfway;
  // The load of a shared machine varies, so interleave the repetitions of different measurements.
  std::vector<char*> arguments(argv, argv + argc);
  std::string interleave = "--benchmark_enable_random_interleaving=true";
  arguments.insert(arguments.begin() + 1, interleave.data());
  auto count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&count, arguments.data());

  Options options;
  CLI::App app{
      "Measures speed, as ratios within one run; of Google Benchmark's options it takes --benchmark_filter",
      "halfway_bench"};
  app.add_option("--page", options.page, "page that is written; needs all measurements");
  app.add_option("--jobs", options.jobs, "builds at a time")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  int exit_code = 0;
  app.callback([&] {
    if (!options.page.empty() && !benchmark::GetBenchmarkFilter().empty())
      throw CLI::ValidationError("--page", "needs all measurements: leave --benchmark_filter out");
    try {
      exit_code = run(options);
    } catch (const Failure& failure) {
      exit_code = cli::report(failure.error);
    }
  });
  return cli::run_program(app, count, arguments.data(), exit_code);
}

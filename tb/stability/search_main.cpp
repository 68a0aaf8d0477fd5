// SPDX-License-Identifier: Apache-2.0
// halfway_search: tries random inputs, until one fails.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "page/page.hpp"
#include "sim/pages/template.hpp"
#include "sim/program/program.hpp"
#include "sim/system/seconds.hpp"
#include "stability/search.hpp"

namespace halfway::stability {
namespace {

// Number of inputs that a thread takes at a time and draws together in the RTL.
constexpr std::uint64_t c_batch = 100;

struct SearchKind {
  std::string_view name;                  ///< the kind of inputs, in the plural
  std::string_view about;                 ///< for the page
  std::uint64_t quick_count, full_count;  ///< inputs of `make test` and of `make search`
  std::uint64_t rtl_every;                ///< one batch in so many is checked in the RTL
  MakeSearch* make;
};

constexpr SearchKind c_searches[] = {
    {"triangles",
     "Random triangles of every kind: slivers one unit thick, triangles of one line, triangles within a "
     "pixel, vertices on pixel centres, vertices anywhere in the guard band. One in four is a piece of a "
     "split triangle, down to level 5. Samples are up to 1023 steps, depths from the near to the far plane, "
     "sides of frames 1 to 4096 pixels. Colour and depth are in steps, minus the half step of rounding; the "
     "bound is that of the pixel's forward differences.",
     20'000, 10'000'000, 25, make_triangle_search},
    {"spherical-scenes",
     "Random scenes in the spherical shader, both presets: up to eight triangles with their own normals, up "
     "to sixteen lights of all kinds, from close to the surface to far away. The figure of a scene is that "
     "of its worst pixel; the bound is that of the set-up's threshold, of bells and of tables. Preset "
     "`published` is only drawn by the RTL.",
     200, 25'000, 10, make_spherical_search},
    {"processor-scenes",
     "The same scenes in the shading processors, both presets and both forms, with and without shadows, with "
     "near planes that cut triangles. The figure of a scene is that of its worst pixel; the bound is that of "
     "the errors of the units. A shadow may fall on any pixel here; the family `shadows` checks shadows.",
     200, 25'000, 10, make_processors_search},
};

struct Options {
  bool quick = false;
  std::uint32_t seed = 1;
  std::uint64_t first = 0;
  std::map<std::string_view, std::uint64_t> counts{};  ///< by name of the search; empty: all searches
  std::filesystem::path page{}, source{};
  SimulatorFolders folders() const { return {source, source / "build" / "cache"}; }
};

// State that all threads of one search share.
class Run {
 public:
  Run(const SearchKind& kind, const Options& options, std::uint64_t count)
      : kind_(kind), options_(options), end_(options.first + count), next_(options.first) {}

  // Batches are taken in order, so that the first failure does not depend on the number of threads.
  void work() {
    const auto search = kind_.make(options_.folders(), options_.quick);
    Tally tally;
    std::vector<std::uint32_t> seeds;
    for (std::uint64_t at; !stop_ && (at = next_.fetch_add(c_batch)) < end_;) {
      seeds.clear();
      for (std::uint64_t i = at; i < std::min(at + c_batch, end_); ++i) {
        seeds.push_back(seed_of(i));
        fail(i, search->check(seeds.back(), tally));
      }
      if ((at - options_.first) / c_batch % kind_.rtl_every != 0) continue;
      if (const auto rtl = search->check_rtl(seeds, tally))
        fail(at, *rtl);
      else
        break_off(rtl.error());
    }
    const std::lock_guard lock(mutex_);
    tally_.add(tally);
  }

  std::uint64_t done() const { return std::min(next_.load(), end_) - options_.first; }
  const Tally& tally() const { return tally_; }
  /// The first input that fails, or the first one of its batch, and the reason.
  const std::map<std::uint64_t, std::string>& failures() const { return failures_; }
  const Status& tools() const { return tools_; }

 private:
  // Different numbers of a run, and runs with neighbouring seeds, share no input.
  std::uint32_t seed_of(std::uint64_t number) const {
    return options_.seed * 0x9E37'79B9U + static_cast<std::uint32_t>(number);
  }
  void fail(std::uint64_t number, const std::string& what) {
    if (what.empty()) return;
    const std::lock_guard lock(mutex_);
    failures_.emplace(number, what);
    stop_ = true;
  }
  void break_off(const Error& error) {
    const std::lock_guard lock(mutex_);
    tools_ = error;
    stop_ = true;
  }

  const SearchKind& kind_;
  const Options& options_;
  std::uint64_t end_;
  std::atomic<std::uint64_t> next_;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  Tally tally_;
  std::map<std::uint64_t, std::string> failures_;
  Status tools_ = Ok{};
};

// Runs the workers and shows their progress on a terminal.
void run_threads(Run& run, const SearchKind& kind, std::uint64_t count, unsigned threads) {
  std::atomic<unsigned> working = threads;  // outlives the workers: each one decrements it at its end
  std::vector<std::jthread> workers;
  for (unsigned i = 0; i < threads; ++i)
    workers.emplace_back([&] {
      run.work();
      --working;
    });
  while (isatty(STDERR_FILENO) && working > 0) {
    fmt::print(stderr, "{}: {} of {}\r", kind.name, run.done(), count);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
}

page::Section section_of(const SearchKind& kind, const Options& options, const Tally& tally, double seconds,
                         double processor_seconds) {
  const std::vector<std::string> columns = {"quantity", "inputs", "worst", "of"};
  std::vector<std::vector<std::string>> rows;
  for (const auto& [quantity, worst] : tally.worst)
    rows.push_back({quantity, std::to_string(worst.count), fmt::format("{:.3g}", worst.figure),
                    fmt::format("{:.3g}", worst.bound)});
  return {fmt::format("Search: {}", kind.name),
          fmt::format("{}\n\n`make search` with seed {}: {} inputs and {} fragments through the golden model "
                      "against the specification, {} inputs and {} fragments through the RTL (Verilator) "
                      "against the golden model; {:.0f} s, {:.0f} s of processor time.\n\n{}",
                      kind.about, options.seed, tally.inputs, tally.fragments, tally.rtl_inputs,
                      tally.rtl_fragments, seconds, processor_seconds, markdown_table(columns, rows))};
}

ExitCode run_search(const SearchKind& kind, const Options& options, std::uint64_t count,
                    std::vector<page::Section>& sections) {
  const auto began = std::chrono::steady_clock::now();
  const std::clock_t processor_began = std::clock();
  Run run(kind, options, count);
  run_threads(run, kind, count, options.quick ? 1 : std::max(1U, std::thread::hardware_concurrency()));
  const Tally& tally = run.tally();
  fmt::print("{}: {} inputs, {} fragments; {} inputs, {} fragments in the RTL; {:.1f} s\n", kind.name,
             tally.inputs, tally.fragments, tally.rtl_inputs, tally.rtl_fragments, seconds_since(began));
  for (const auto& [quantity, worst] : tally.worst)
    fmt::print("  {}: {:.4g} of {:.4g} at worst, {} inputs {}\n", quantity, worst.figure, worst.bound,
               worst.count, worst.where.empty() ? "" : "(" + worst.where + ")");
  if (!run.failures().empty()) {
    const auto& [number, what] = *run.failures().begin();
    fmt::print("FAILS: {}; again: halfway_search --seed {} --first {} --{} {} .\n", what, options.seed,
               number, kind.name, c_batch);
    return ExitCode::differs;
  }
  if (!run.tools()) {
    fmt::print(stderr, "{}\n", run.tools().error().message);
    return run.tools().error().code;
  }
  sections.push_back(section_of(kind, options, tally, seconds_since(began),
                                double(std::clock() - processor_began) / CLOCKS_PER_SEC));
  return ExitCode::equal;
}

ExitCode run_all(const Options& options) {
  std::vector<page::Section> sections;
  ExitCode worst = ExitCode::equal;
  for (const SearchKind& kind : c_searches) {
    std::uint64_t count = options.quick ? kind.quick_count : kind.full_count;
    if (!options.counts.empty()) {
      const auto asked = options.counts.find(kind.name);
      if (asked == options.counts.end()) continue;
      count = asked->second;
    }
    worst = std::max(worst, run_search(kind, options, count, sections));
  }
  if (options.page.empty()) return worst;
  const auto written = page::write_sections(options.page, sections);
  if (written) return worst;
  fmt::print(stderr, "{}\n", written.error().message);
  return written.error().code;
}

}  // namespace
}  // namespace halfway::stability

int main(int argc, char** argv) {
  using namespace halfway;
  using namespace halfway::stability;
  Options options;
  CLI::App app{"Tests random inputs, until one fails", "halfway_search"};
  app.add_flag("--quick", options.quick, "few inputs of each search");
  app.add_option("--seed", options.seed, "other inputs")->capture_default_str();
  app.add_option("--first", options.first, "number of the first input")->capture_default_str();
  for (const SearchKind& kind : c_searches)
    app.add_option_function<std::uint64_t>(
        fmt::format("--{}", kind.name),
        [&options, name = kind.name](std::uint64_t count) { options.counts[name] = count; },
        "run this search with this number of inputs; searches without such an option do not run");
  app.add_option("--page", options.page, "page whose sections of searches are written");
  app.add_option("SOURCE", options.source, "the project's root")->required();
  int exit_code = 0;
  app.callback([&] {
    options.source = std::filesystem::absolute(options.source);
    exit_code = static_cast<int>(run_all(options));
  });
  return cli::run_program(app, argc, argv, exit_code);
}

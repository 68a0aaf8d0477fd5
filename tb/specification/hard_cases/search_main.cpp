// SPDX-License-Identifier: Apache-2.0
// halfway_search: tries random inputs, until one fails.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "evidence/page.hpp"
#include "sim/files/template.hpp"
#include "sim/os/command_line.hpp"
#include "sim/os/seconds.hpp"
#include "sim/os/threads.hpp"
#include "specification/hard_cases/search.hpp"

namespace halfway::stability {
namespace {

// Number of inputs that a thread takes at a time and draws together in the RTL.
constexpr std::uint64_t c_batch = 100;

struct SearchKind {
  std::string_view name;                  ///< the kind of inputs, in the plural
  std::string_view about;                 ///< for the page
  std::uint64_t quick_count, full_count;  ///< inputs of `make test` and of `make search`
  std::uint64_t rtl_every;                ///< one batch in so many is checked in the RTL
  std::optional<Shader> shader{};         ///< of scenes; the triangles have none
};

constexpr SearchKind c_searches[] = {
    {"triangles",
     "Random triangles of every kind: slivers one unit thick, triangles of one line, triangles within a "
     "pixel, vertices on pixel centres, vertices anywhere in the guard band. One in four is a piece of a "
     "split triangle, down to level 5. Samples are up to 1023 steps, depths from the near to the far plane, "
     "sides of frames 1 to 4096 pixels. Colour and depth are in steps, minus the half step of rounding; the "
     "bound is that of the pixel's forward differences.",
     20'000, 10'000'000, 25},
    {"patches",
     "Random triangles of 1 to 4096 pixels in the quadratic shader, preset `exact`, with the conservative "
     "and the proved test and thresholds T of 0.5 to 8 steps: flat or curved, with normals that agree, "
     "differ or nearly cancel, seen from close to far away. One to three lights, or 16, of all kinds: with a "
     "highlight on the triangle or next to it, along the surface, opposite to the eye, from 10⁻³ to 100 of "
     "its size away; spots with soft and hard edges; Blinn, Phong (n from 1 to 1000) and Cook–Torrance. "
     "Planes with the proved test, too. The figure of a triangle is the error of its worst pixel beyond the "
     "rounding of the hardware, divided by T. The last row counts triangles with leaves that `make sim` "
     "reports as unresolved; they have no bound.",
     2'000, 1'000'000, 100, Shader::quadratic},
    {"spherical-scenes",
     "Random scenes in the spherical shader, both presets: up to eight triangles with their own normals, up "
     "to sixteen lights of all kinds, from close to the surface to far away. The figure of a scene is that "
     "of its worst pixel; the bound is that of the set-up's threshold, of bells and of tables. Preset "
     "`published` is only drawn by the RTL.",
     200, 25'000, 10, Shader::spherical},
    {"processor-scenes",
     "The same scenes in the shading processors, both presets and both forms, with and without shadows, with "
     "near planes that cut triangles. The figure of a scene is that of its worst pixel; the bound is that of "
     "the errors of the units. A shadow may fall on any pixel here; the family `shadows` checks shadows.",
     200, 25'000, 10, Shader::processors},
};

struct Options {
  bool quick = false;
  std::uint32_t seed = 1;
  std::uint64_t first = 0;
  std::map<std::string_view, std::uint64_t> counts{};  ///< by name of the search; empty: all searches
  std::filesystem::path page{}, source{};
  SimulatorFolders folders() const { return {source, source / "build" / "cache"}; }
};

// What the threads of one search share.
struct Shared {
  std::mutex mutex{};
  std::vector<std::unique_ptr<Search>> idle{};
  Tally tally{};
};

// Checks the inputs from `first` on. An error names the input that fails, or the first one of a batch that
// fails in the RTL, and how to make it again.
Status check_batch(const SearchKind& kind, const Options& options, std::uint64_t first, std::uint64_t end,
                   Search& search, Tally& tally) {
  const auto failed = [&](std::uint64_t number, const std::string& what) -> Status {
    if (what.empty()) return Ok{};
    return Error{ExitCode::differs, fmt::format("{}; again: halfway_search --seed {} --first {} --{} {} .",
                                                what, options.seed, number, kind.name, c_batch)};
  };
  std::vector<std::uint32_t> seeds;
  for (std::uint64_t i = first; i < end; ++i) {
    // Different numbers of a run, and runs with neighbouring seeds, share no input.
    seeds.push_back(options.seed * 0x9E37'79B9U + static_cast<std::uint32_t>(i));
    if (Status status = failed(i, search.check(seeds.back(), tally)); !status) return status;
  }
  if ((first - options.first) / c_batch % kind.rtl_every != 0) return Ok{};
  const auto rtl = search.check_rtl(seeds, tally);
  return rtl ? failed(first, *rtl) : Status(rtl.error());
}

// Checks batch after batch on threads, each with a search of its own. The first failure does not depend on
// the number of threads.
Status check_all(const SearchKind& kind, const Options& options, std::uint64_t count, Shared& shared) {
  const unsigned threads = options.quick ? 1 : std::max(1U, std::thread::hardware_concurrency());
  return caught([&] {
    must_for_each(threads, (count + c_batch - 1) / c_batch, [&](std::size_t batch) {
      std::unique_lock lock(shared.mutex);
      if (isatty(STDERR_FILENO)) fmt::print(stderr, "{}: {} of {}\r", kind.name, batch * c_batch, count);
      if (shared.idle.empty())
        shared.idle.push_back(kind.shader ? make_scene_search(*kind.shader, options.folders(), options.quick)
                                          : make_triangle_search(options.folders()));
      std::unique_ptr<Search> search = std::move(shared.idle.back());
      shared.idle.pop_back();
      lock.unlock();
      Tally tally;
      const std::uint64_t first = options.first + batch * c_batch,
                          end = options.first + std::min((batch + 1) * c_batch, count);
      Status status = check_batch(kind, options, first, end, *search, tally);
      lock.lock();
      shared.idle.push_back(std::move(search));
      shared.tally.add(tally);
      must(std::move(status));
    });
  });
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
  Shared shared;
  const Status status = check_all(kind, options, count, shared);
  const Tally& tally = shared.tally;
  fmt::print("{}: {} inputs, {} fragments; {} inputs, {} fragments in the RTL; {:.1f} s\n", kind.name,
             tally.inputs, tally.fragments, tally.rtl_inputs, tally.rtl_fragments, seconds_since(began));
  for (const auto& [quantity, worst] : tally.worst)
    fmt::print("  {}: {:.4g} of {:.4g} at worst, {} inputs {}\n", quantity, worst.figure, worst.bound,
               worst.count, worst.where.empty() ? "" : "(" + worst.where + ")");
  if (!status) {
    fmt::print("FAILS: {}\n", status.error().message);
    return status.error().code;
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

void Tally::add(const Tally& other) {
  inputs += other.inputs;
  fragments += other.fragments;
  rtl_inputs += other.rtl_inputs;
  rtl_fragments += other.rtl_fragments;
  for (const auto& [quantity, theirs] : other.worst) {
    Worst& ours = worst[quantity];
    const std::uint64_t count = ours.count + theirs.count;
    ours.add(theirs.figure, theirs.bound, [&where = theirs.where] { return where; });
    ours.count = count;
  }
}

std::string Tally::add(const char* quantity, const Worst& of_input) {
  if (of_input.count == 0) return "";
  worst[quantity].add(of_input.figure, of_input.bound, [&] { return of_input.where; });
  if (of_input.within()) return "";
  return fmt::format("{}: {}: {:.4g} of {:.4g}", quantity, of_input.where, of_input.figure, of_input.bound);
}

Result<std::string> rtl_failure(const Trial& trial, std::uint64_t inputs, Tally& tally) {
  if (!trial.tools()) return trial.tools().error();
  tally.rtl_inputs += inputs;
  tally.rtl_fragments += trial.rtl_fragments();
  return trial.failure();
}

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

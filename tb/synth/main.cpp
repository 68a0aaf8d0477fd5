// SPDX-License-Identifier: Apache-2.0
// halfway_synth: synthesizes every design of the list by Yosys for two FPGA families, and places it by
// nextpnr for an iCE40 HX8K. Writes one table, and compares the figures with those pinned in
// tb/synth/pinned.txt.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "designs.hpp"
#include "sim/cli/options.hpp"
#include "sim/program/program.hpp"
#include "sim/synth/pinned.hpp"
#include "sim/synth/synthesis.hpp"
#include "sim/system/file.hpp"
#include "sim/system/machine.hpp"
#include "sim/system/page_part.hpp"
#include "sim/system/seconds.hpp"
#include "sim/system/subprocess.hpp"
#include "sim/system/threads.hpp"

namespace halfway::synth {
namespace {

constexpr std::string_view c_table = "## Figures\n";  // of the page; the text after it is rewritten
constexpr std::string_view c_head =
    "| design | LUTs | carries | flip-flops | RAMs | clock, MHz | seeds, MHz | ns a pixel | published, ns | "
    "critical path | ECP5: LUTs | flip-flops | RAMs | multipliers |\n"
    "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";

constexpr const char* c_readme_part = "clocks";
constexpr const char* c_endless = "nextpnr does not end";

struct Options {
  bool quick = false, cells = false, pin = false, check = false;
  unsigned seeds = c_seeds, jobs = 2;
  std::filesystem::path page{}, readme{};
  SimulatorFolders folders{};
  std::string part{};
};

// The figures of a design.
struct Figures {
  std::optional<Ice40Cells> ice40{};
  std::optional<Ecp5Cells> ecp5{};
  std::string netlist{};
  std::string no_room{};                ///< Synthesizer::no_room
  unsigned endless = 0;                 ///< placements that did not end
  std::vector<Placement> placements{};  ///< sorted by clock, slowest first, once all have ended
  const Placement* median() const {
    return placements.empty() ? nullptr : &placements[placements.size() / 2];
  }
  bool fits() const { return !placements.empty() && placements.front().fits(); }
  double mhz() const { return fits() ? median()->mhz : 0; }
};

std::string path_text(const CriticalPath& path) {
  return fmt::format("`{}` → `{}`: {} LUTs, {} carries, {:.1f} ns in cells, {:.1f} ns in wires", path.from,
                     path.to, path.luts, path.carries, path.logic, path.routing);
}

std::string row_begin(const std::string& name) {
  return fmt::format("| `{}` |", name);
}

std::string not_placed(const Figures& f) {
  if (!f.ice40) return "not placed: its processors alone do not fit the HX8K";
  if (!f.no_room.empty()) return "not placed: " + f.no_room;
  if (!f.placements.empty()) return "not placed: does not fit the HX8K";
  return f.endless > 0 ? fmt::format("not placed: {} with {} seeds", c_endless, f.endless) : "not placed";
}

// The range and number of the seeds of which the clock is the median.
std::string seeds_text(const Figures& f) {
  return fmt::format("{:.0f} to {:.0f} of {}{}", f.placements.front().mhz, f.placements.back().mhz,
                     f.placements.size(),
                     f.endless > 0 ? fmt::format("; {}: {}", c_endless, f.endless) : std::string());
}

std::string row(const ListedDesign& listed, const Figures& f) {
  std::string text = row_begin(listed.design.name);
  if (f.ice40)
    text += fmt::format(" {} | {} | {} | {} |", f.ice40->luts, f.ice40->carries, f.ice40->flip_flops,
                        f.ice40->rams);
  else
    text += " – | – | – | – |";
  const auto published = published_ns(listed.design.name);
  const std::string printed = published ? std::to_string(*published) : "–";
  if (f.fits())
    text += fmt::format(" {:.0f} | {} | {:.1f} | {} | {} |", f.mhz(), seeds_text(f), 1000 / f.mhz(), printed,
                        path_text(f.median()->path));
  else
    text += fmt::format(" – | – | – | {} | {} |", printed, not_placed(f));
  if (f.ecp5)
    text += fmt::format(" {} | {} | {} | {} |\n", f.ecp5->luts, f.ecp5->flip_flops, f.ecp5->rams,
                        f.ecp5->multipliers);
  else
    text += " – | – | – | – |\n";
  return text;
}

// Check before the long measurement that its results can be written.
Status check_written(const Options& options) {
  if (!options.page.empty())
    if (const auto page = read_file(options.page); !page) return page.error();
  if (options.readme.empty()) return Ok{};
  const auto readme = read_file(options.readme);
  if (!readme) return readme.error();
  if (const auto part = page_part(*readme, c_readme_part); !part)
    return bad_input(fmt::format("{}: {}", options.readme.string(), part.error().message));
  return Ok{};
}

// Keep the rows of designs that were measured before, and drop those of designs that no longer exist.
Status write_page(const std::filesystem::path& path, const std::map<std::string, std::string>& rows,
                  const std::string& versions) {
  auto text = read_file(path);
  if (!text) return text.error();
  const std::size_t figures = std::min(text->find(c_table), text->size());
  std::string table(c_head);
  for (const ListedDesign& listed : all_designs()) {
    const std::string& name = listed.design.name;
    const auto measured = rows.find(name);
    const std::size_t before = text->find(row_begin(name), figures);
    if (measured != rows.end())
      table += measured->second;
    else if (before != std::string::npos)
      table += text->substr(before, text->find('\n', before) + 1 - before);
  }
  text->resize(figures);
  return write_file(path, fmt::format("{}{}\nBy {}, on {}, {}.\n\n{}", *text, c_table, versions, machine(),
                                      operating_system(), table));
}

// With a part, the other pins are kept. Without one, or without a file, all are written again.
Result<Pins> pins_before(const Options& options) {
  const auto path = options.folders.source / c_pins;
  if (options.pin && (options.part.empty() || !std::filesystem::exists(path))) return Pins{};
  return read_pins(path);
}

// Uses the pins as read from the file, where they are rounded.
Status write_readme(const std::filesystem::path& path, const std::filesystem::path& pinned) {
  const auto pins = read_pins(pinned);
  if (!pins) return pins.error();
  const auto clocks = readme_clocks(*pins);
  if (!clocks) return clocks.error();
  return rewrite_page(path,
                      [&](const std::string& page) { return with_page_part(page, c_readme_part, *clocks); });
}

class Run {
 public:
  Run(const Options& options, const Synthesizer& synthesizer, std::vector<ListedDesign> designs, Pins pins)
      : options_(options),
        synthesizer_(synthesizer),
        designs_(std::move(designs)),
        figures_(designs_.size()),
        pins_(std::move(pins)) {}

  /// Start large designs first, by their pinned size, so that the last job is not the longest one.
  ExitCode run() {
    std::vector<std::size_t> order(designs_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return pinned_luts(a) > pinned_luts(b); });
    std::vector<Job> jobs;
    for (const std::size_t i : order)
      if (designs_[i].ice40) jobs.push_back({i, Job::Kind::ice40});
    for (const std::size_t i : order)
      if (!options_.quick) jobs.push_back({i, Job::Kind::ecp5});
    work(jobs, "cells");
    jobs.clear();
    if (!options_.cells)
      for (const std::size_t i : order)
        for (unsigned seed = 1; figures_[i].ice40 && figures_[i].no_room.empty() && seed <= options_.seeds;
             ++seed)
          jobs.push_back({i, Job::Kind::place, seed});
    work(jobs, "clocks");
    for (Figures& f : figures_)
      std::sort(f.placements.begin(), f.placements.end(),
                [](const Placement& a, const Placement& b) { return a.mhz < b.mhz; });
    return report();
  }

 private:
  struct Job {
    std::size_t design;
    enum class Kind { ice40, ecp5, place } kind;
    unsigned seed = 0;
  };

  // A new design counts as the largest.
  std::uint64_t pinned_luts(std::size_t design) const {
    const auto pin = pins_.find(designs_[design].design.name);
    return pin == pins_.end() ? ~std::uint64_t{0} : pin->second.cells.luts;
  }

  std::string what(const Job& job) const {
    const std::string& name = designs_[job.design].design.name;
    if (job.kind == Job::Kind::place) return fmt::format("{}, seed {}", name, job.seed);
    return fmt::format("{}, {}", name, job.kind == Job::Kind::ice40 ? "iCE40" : "ECP5");
  }

  // Prints one line per job on stdout. A terminal also shows the running jobs below them.
  void work(const std::vector<Job>& jobs, const std::string& figures) {
    std::size_t done = 0;
    cli::Progress progress(figures);
    std::set<std::size_t> under_way;
    const auto show = [&] {
      std::vector<std::string> texts;
      for (const std::size_t at : under_way) texts.push_back(what(jobs[at]));
      progress.show(fmt::format("{} of {}; {}", done, jobs.size(), fmt::join(texts, "; ")));
    };
    // A job that fails does not stop the others: each returns as done.
    static_cast<void>(for_each_on_threads(options_.jobs, jobs.size(), [&](std::size_t at) -> Status {
      {
        const std::lock_guard lock(mutex_);
        under_way.insert(at);
        show();
      }
      const auto began = std::chrono::steady_clock::now();
      const auto said = work(jobs[at]);
      const double seconds = seconds_since(began);
      const std::lock_guard lock(mutex_);
      under_way.erase(at);
      ++done;
      progress.clear();
      if (said) {
        fmt::print("[{}/{}] {}: {} ({:.1f} s)\n", done, jobs.size(), what(jobs[at]), *said, seconds);
        std::fflush(stdout);
      } else {
        ++broken_;
        cli::report(said.error());
      }
      show();
      return Ok{};
    }));
  }

  Result<std::string> work(const Job& job) {
    const Design& design = designs_[job.design].design;
    Figures& f = figures_[job.design];
    if (job.kind == Job::Kind::ice40) {
      const auto cells = synthesizer_.ice40(design);
      if (!cells) return cells.error();
      const auto netlist = synthesizer_.netlist_hash(design);
      if (!netlist) return netlist.error();
      std::string no_room;
      if (!options_.cells) {
        const auto told = synthesizer_.no_room(design);
        if (!told) return told.error();
        no_room = *told;
      }
      const std::lock_guard lock(mutex_);
      f.ice40 = *cells;
      f.netlist = *netlist;
      f.no_room = no_room;
      return fmt::format("{} LUTs, {} flip-flops{}{}", cells->luts, cells->flip_flops,
                         no_room.empty() ? "" : "; ", no_room);
    }
    if (job.kind == Job::Kind::ecp5) {
      const auto cells = synthesizer_.ecp5(design);
      if (!cells) return cells.error();
      const std::lock_guard lock(mutex_);
      f.ecp5 = *cells;
      return fmt::format("{} LUTs, {} flip-flops", cells->luts, cells->flip_flops);
    }
    const auto placement = synthesizer_.place(design, job.seed);
    if (!placement) return placement.error();
    const std::lock_guard lock(mutex_);
    if (!placement->ended) {
      ++f.endless;
      return std::string(c_endless);
    }
    f.placements.push_back(*placement);
    if (!placement->fits()) return std::string("does not fit the HX8K");
    return fmt::format("{:.1f} MHz; {}", placement->mhz, path_text(placement->path));
  }

  ExitCode report() {
    std::map<std::string, std::string> rows;
    fmt::print("\n{}", c_head);
    for (std::size_t i = 0; i < designs_.size(); ++i) {
      rows[designs_[i].design.name] = row(designs_[i], figures_[i]);
      fmt::print("{}", rows[designs_[i].design.name]);
    }
    fmt::print("\n");
    if (broken_ > 0)
      return failed(tool_failed(fmt::format("{}: {} figures could not be had, and nothing is compared",
                                            options_.folders.source.string(), broken_)));
    const auto compared = options_.pin ? pin() : compare_all();
    if (!compared) return failed(compared.error());
    if (!options_.page.empty())
      if (const Status written = write_page(options_.page, rows, synthesizer_.versions()); !written)
        return failed(written.error());
    return *compared;
  }

  Result<ExitCode> pin() {
    std::size_t pinned = 0, hasty = 0;
    for (std::size_t i = 0; i < designs_.size(); ++i) {
      const Figures& f = figures_[i];
      if (!f.ice40) continue;
      ++pinned;
      Pin& pin = pins_[designs_[i].design.name];
      pin.cells = *f.ice40;
      // If no placement has ended, keep the clock and its netlist.
      if (f.fits() || f.endless == 0 || pin.mhz == 0) {
        pin.mhz = f.mhz();
        pin.netlist = f.netlist;
        if (f.fits()) pin.seeds = static_cast<unsigned>(f.placements.size());
        if (f.fits() && pin.seeds < c_seeds) ++hasty;
      }
    }
    std::set<std::string> listed;
    for (const ListedDesign& each : all_designs())
      if (each.ice40) listed.insert(each.design.name);
    std::erase_if(pins_, [&](const auto& pin) { return !listed.contains(pin.first); });
    const Status written = write_pins(options_.folders.source / c_pins, pins_, synthesizer_.versions());
    if (!written) return written.error();
    if (!options_.readme.empty())
      if (const Status told = write_readme(options_.readme, options_.folders.source / c_pins); !told)
        return told.error();
    fmt::print("{} designs are pinned\n", pinned);
    if (hasty > 0)
      cli::say(fmt::format(
          "note: {} clocks are pinned of fewer than the usual {} seeds, as {} says of each; of few "
          "a median is luck",
          hasty, c_seeds, c_pins));
    return ExitCode::equal;
  }

  Result<ExitCode> compare_all() const {
    int wrong = 0, others = 0;
    for (std::size_t i = 0; i < designs_.size(); ++i) {
      const Figures& f = figures_[i];
      if (!f.ice40) continue;
      const std::string& name = designs_[i].design.name;
      const std::string text =
          compare(name, pins_, *f.ice40, options_.cells ? std::nullopt : std::optional(f.mhz()));
      if (!text.empty()) ++wrong;
      fmt::print(stderr, "{}", text);
      const auto pin = pins_.find(name);
      if (pin != pins_.end() && pin->second.netlist != f.netlist) ++others;
    }
    fmt::print("{} of {} designs are not as pinned\n", wrong, designs_.size());
    if (others > 0)
      cli::say(fmt::format(
          "note: {} clocks that are pinned are of another netlist or flow: a study knows none of them until "
          "make synth PIN=1",
          others));
    return wrong == 0 ? ExitCode::equal : ExitCode::differs;
  }

  static ExitCode failed(const Error& error) { return static_cast<ExitCode>(cli::report(error)); }

  const Options& options_;
  const Synthesizer& synthesizer_;
  std::vector<ListedDesign> designs_;
  std::vector<Figures> figures_;
  Pins pins_;
  std::mutex mutex_;
  int broken_ = 0;
};

int main_of(const Options& options) {
  std::vector<ListedDesign> designs;
  for (ListedDesign& listed : all_designs())
    if ((listed.quick || !options.quick) && listed.design.name.find(options.part) != std::string::npos)
      designs.push_back(std::move(listed));
  if (designs.empty()) {
    return cli::report(bad_input(fmt::format(
        "{}: no design has this in its name; docs/results/synthesis.md lists them", options.part)));
  }
  if (const Status written = check_written(options); !written) return cli::report(written.error());
  auto pins = pins_before(options);
  if (!pins) return cli::report(pins.error());
  if (options.check) return 0;
  const auto synthesizer = Synthesizer::open(options.folders, !options.cells, {c_accumulator});
  if (!synthesizer) {
    cli::say(synthesizer.error().message);
    return static_cast<int>(synthesizer.error().code);
  }
  return static_cast<int>(Run(options, *synthesizer, std::move(designs), std::move(*pins)).run());
}

}  // namespace
}  // namespace halfway::synth

int main(int argc, char** argv) {
  using namespace halfway;
  synth::Options options;
  CLI::App app{"Cells on two FPGA families and the clock on an iCE40 HX8K, against what is pinned",
               "halfway_synth"};
  auto* quick = app.add_flag("--quick", options.quick, "small designs, without ECP5");
  auto* cells = app.add_flag("--cells", options.cells, "no place and route");
  auto* pin =
      app.add_flag("--pin", options.pin, "write the figures into the pinned file in place of comparing")
          ->excludes(quick)
          ->excludes(cells);
  app.add_flag("--check", options.check, "measure nothing: only look whether what is asked for can be");
  app.add_option("--seeds", options.seeds, "of placement")->check(CLI::Range(1, 999))->capture_default_str();
  app.add_option("--jobs", options.jobs, "at a time")->check(CLI::Range(1, 999))->capture_default_str();
  // The rows of the page would be incomplete.
  app.add_option("--page", options.page, "file whose table is written anew")
      ->excludes(quick)
      ->excludes(cells);
  app.add_option("--readme", options.readme, "file whose part 'clocks' is written by what is pinned")
      ->needs(pin);
  app.add_option("SOURCE", options.folders.source, "the project's root")->required();
  app.add_option("CACHE", options.folders.cache, "folder of what was made before")->required();
  app.add_option("PART", options.part, "only designs whose names hold it");
  int exit_code = 0;
  app.callback([&] {
    options.folders.source = std::filesystem::absolute(options.folders.source);
    options.folders.cache = std::filesystem::absolute(options.folders.cache);
    exit_code = synth::main_of(options);
  });
  return cli::run_program(app, argc, argv, exit_code);
}

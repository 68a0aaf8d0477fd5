// SPDX-License-Identifier: Apache-2.0
// halfway_synth: synthesizes every design of the list by Yosys for two FPGA families, and places it by
// nextpnr for an iCE40 HX8K. Writes one table, and compares the figures with those pinned in
// tb/synth/pinned.txt. Each design has a row of evidence.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
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
#include "evidence/evidence.hpp"
#include "sim/cli/options.hpp"
#include "sim/program/program.hpp"
#include "sim/synth/pinned.hpp"
#include "sim/synth/synthesis.hpp"
#include "sim/system/file.hpp"
#include "sim/system/page_part.hpp"
#include "sim/system/seconds.hpp"
#include "sim/system/subprocess.hpp"
#include "sim/system/threads.hpp"

namespace halfway::synth {
namespace {

constexpr std::string_view c_section = "Figures";  // of the page
constexpr const char* c_design_column = "design";

constexpr const char* c_readme_part = "clocks";
constexpr const char* c_endless = "nextpnr does not end";

struct Options {
  bool quick = false, cells = false, pin = false, check = false;
  unsigned seeds = c_seeds, jobs = 2;
  evidence::Mode mode = evidence::Mode::none;
  std::filesystem::path page{"docs/results/synthesis.md"}, readme{};
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
  unsigned remaining = 0;               ///< placements to be made
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

// Today's row without its measured fields.
evidence::Today described(const ListedDesign& listed) {
  return {.name = listed.design.name,
          .section = std::string(c_section),
          .fields = {{c_design_column, fmt::format("`{}`", listed.design.name)}}};
}

evidence::Row row(const ListedDesign& listed, const Figures& f) {
  evidence::Row row = described(listed);
  const auto add = [&](const char* column, const std::string& cell) {
    row.fields.emplace_back(column, cell);
  };
  const auto count = [](bool exists, std::uint64_t cells) {
    return exists ? std::to_string(cells) : std::string("–");
  };
  const Ice40Cells ice40 = f.ice40.value_or(Ice40Cells{});
  add("LUTs", count(f.ice40.has_value(), ice40.luts));
  add("carries", count(f.ice40.has_value(), ice40.carries));
  add("flip-flops", count(f.ice40.has_value(), ice40.flip_flops));
  add("RAMs", count(f.ice40.has_value(), ice40.rams));
  const auto published = published_ns(listed.design.name);
  add("clock, MHz", f.fits() ? fmt::format("{:.0f}", f.mhz()) : "–");
  add("seeds, MHz", f.fits() ? seeds_text(f) : "–");
  add("ns per pixel", f.fits() ? fmt::format("{:.1f}", 1000 / f.mhz()) : "–");
  add("paper, ns", published ? std::to_string(*published) : "–");
  add("critical path", f.fits() ? path_text(f.median()->path) : not_placed(f));
  const Ecp5Cells ecp5 = f.ecp5.value_or(Ecp5Cells{});
  add("ECP5: LUTs", count(f.ecp5.has_value(), ecp5.luts));
  add("ECP5: flip-flops", count(f.ecp5.has_value(), ecp5.flip_flops));
  add("ECP5: RAMs", count(f.ecp5.has_value(), ecp5.rams));
  add("ECP5: multipliers", count(f.ecp5.has_value(), ecp5.multipliers));
  return row;
}

// Check before the long measurement that its results can be written.
Status check_written(const Options& options) {
  if (options.mode != evidence::Mode::none)
    if (const auto page = read_file(options.folders.source / options.page); !page) return page.error();
  if (options.readme.empty()) return Ok{};
  const auto readme = read_file(options.readme);
  if (!readme) return readme.error();
  if (const auto part = page_part(*readme, c_readme_part); !part)
    return bad_input(fmt::format("{}: {}", options.readme.string(), part.error().message));
  return Ok{};
}

// The page's figures, with the tools and the machine of the last measurement.
std::vector<page::Section> sections(std::span<const evidence::Row> rows, const std::string& versions) {
  std::vector<page::Section> sections = evidence::sections_of(rows);
  for (page::Section& section : sections) section.body = fmt::format("By {}.\n\n{}", versions, section.body);
  return sections;
}

// With a part, the other pins are kept. Without one, or without a file, all are written again.
Result<Pins> pins_before(const Options& options) {
  const auto path = options.folders.source / c_pins;
  if (options.pin &&
      ((options.part.empty() && options.mode != evidence::Mode::stale) || !std::filesystem::exists(path)))
    return Pins{};
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
    if (options_.mode != evidence::Mode::none) {
      const auto known = open_evidence();
      if (!known) return failed(known.error());
      if (options_.mode == evidence::Mode::check) return check();
      if (options_.mode == evidence::Mode::stale)
        std::erase_if(designs_, [&](const ListedDesign& listed) { return !is_stale(listed); });
      figures_.assign(designs_.size(), {});
    }
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
        for (unsigned seed = 1;
             figures_[i].ice40 && figures_[i].no_room.empty() && seed <= seeds_of(designs_[i]); ++seed) {
          jobs.push_back({i, Job::Kind::place, seed});
          ++figures_[i].remaining;
        }
    // A design without placements is measured.
    for (std::size_t i = 0; i < designs_.size(); ++i)
      if (figures_[i].remaining == 0) finish(i);
    work(jobs, "clocks");
    return report();
  }

 private:
  struct Job {
    std::size_t design;
    enum class Kind { ice40, ecp5, place } kind;
    unsigned seed = 0;
  };

  // Today's rows, with the hashes of the selected designs.
  Status open_evidence() {
    std::vector<ListedDesign> all = all_designs();
    std::vector<evidence::Today> today;
    for (const ListedDesign& listed : all) today.push_back(described(listed));
    std::vector<std::string> netlists(all.size());
    const Status hashed = for_each_on_threads(options_.jobs, all.size(), [&](std::size_t i) -> Status {
      const Design& design = all[i].design;
      if (design.name.find(options_.part) == std::string::npos) return Ok{};
      auto netlist = synthesizer_.netlist_hash(design);
      if (!netlist) return netlist.error();
      today[i].hash =
          ContentHash().add("cells 1").add(*netlist).add(flow_hash()).add(synthesizer_.versions()).hex();
      netlists[i] = std::move(*netlist);
      return Ok{};
    });
    if (!hashed) return hashed;
    for (std::size_t i = 0; i < all.size(); ++i) netlists_[all[i].design.name] = netlists[i];
    auto opened = evidence::Evidence::open(
        {.root = options_.folders.source,
         .rows = "tb/synth/evidence.txt",
         .page = options_.page.string(),
         .sections = [versions = synthesizer_.versions()](
                         std::span<const evidence::Row> rows) { return sections(rows, versions); }},
        std::move(today));
    if (!opened) return opened.error();
    evidence_ = std::move(*opened);
    return Ok{};
  }

  // The pin is of another netlist.
  bool is_pin_stale(const ListedDesign& listed) const {
    const auto pin = pins_.find(listed.design.name);
    return listed.ice40 && (pin == pins_.end() || pin->second.netlist != netlists_.at(listed.design.name));
  }
  bool is_stale(const ListedDesign& listed) const {
    return evidence_->is_stale(listed.design.name) || is_pin_stale(listed);
  }

  ExitCode check() const {
    int stale = 0;
    for (const ListedDesign& listed : designs_)
      if (is_pin_stale(listed)) {
        ++stale;
        fmt::print(stderr, "{}: {}: is pinned for another netlist; make evidence pins it again\n", c_pins,
                   listed.design.name);
      }
    const ExitCode rows = evidence::report(*evidence_);
    return stale > 0 ? ExitCode::differs : rows;
  }

  // Evidence is renewed with the number of seeds that was pinned.
  unsigned seeds_of(const ListedDesign& listed) const {
    const auto pin = pins_.find(listed.design.name);
    return options_.mode == evidence::Mode::stale && pin != pins_.end() ? pin->second.seeds : options_.seeds;
  }

  // Store a measured design: its row and, if requested, its pin.
  void finish(std::size_t i) {
    Figures& f = figures_[i];
    std::ranges::sort(f.placements, {}, &Placement::mhz);
    const bool is_measured = broken_designs_.count(i) == 0 && (f.ice40 || !designs_[i].ice40);
    if (!is_measured || options_.mode == evidence::Mode::none) return;
    evidence::Row measured = row(designs_[i], f);
    measured.hash = evidence_->hash_of(measured.name);
    Status stored = evidence_->put(measured);
    if (stored && options_.pin) {
      pin_design(i);
      stored = write_pins(options_.folders.source / c_pins, pins_, synthesizer_.versions());
    }
    if (!stored) {
      ++broken_;
      cli::report(stored.error());
    }
  }

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
        broken_designs_.insert(jobs[at].design);
        cli::report(said.error());
      }
      if (jobs[at].kind == Job::Kind::place && --figures_[jobs[at].design].remaining == 0)
        finish(jobs[at].design);
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
        const auto text = synthesizer_.no_room(design);
        if (!text) return text.error();
        no_room = *text;
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
    std::vector<evidence::Row> rows;
    for (std::size_t i = 0; i < designs_.size(); ++i) rows.push_back(row(designs_[i], figures_[i]));
    for (const page::Section& section : evidence::sections_of(rows)) fmt::print("\n{}\n", section.body);
    if (broken_ > 0)
      return failed(tool_failed(fmt::format("{}: {} figures could not be had, and nothing is compared",
                                            options_.folders.source.string(), broken_)));
    const auto compared = options_.pin ? pin() : compare_all();
    if (!compared) return failed(compared.error());
    if (evidence_)
      if (const Status written = evidence_->finish(); !written) return failed(written.error());
    return *compared;
  }

  void pin_design(std::size_t i) {
    const Figures& f = figures_[i];
    if (!f.ice40) return;
    Pin& pin = pins_[designs_[i].design.name];
    pin.cells = *f.ice40;
    // If no placement has ended, keep the clock and its netlist.
    if (f.fits() || f.endless == 0 || pin.mhz == 0) {
      pin.mhz = f.mhz();
      pin.netlist = f.netlist;
      if (f.fits()) pin.seeds = static_cast<unsigned>(f.placements.size());
    }
  }

  Result<ExitCode> pin() {
    std::size_t pinned = 0, hasty = 0;
    for (std::size_t i = 0; i < designs_.size(); ++i) {
      const Figures& f = figures_[i];
      if (!f.ice40) continue;
      ++pinned;
      pin_design(i);
      if (f.fits() && pins_[designs_[i].design.name].seeds < c_seeds) ++hasty;
    }
    std::set<std::string> listed;
    for (const ListedDesign& each : all_designs())
      if (each.ice40) listed.insert(each.design.name);
    std::erase_if(pins_, [&](const auto& pin) { return !listed.contains(pin.first); });
    const Status written = write_pins(options_.folders.source / c_pins, pins_, synthesizer_.versions());
    if (!written) return written.error();
    if (!options_.readme.empty())
      if (const Status readme = write_readme(options_.readme, options_.folders.source / c_pins); !readme)
        return readme.error();
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
  std::optional<evidence::Evidence> evidence_;
  std::map<std::string, std::string> netlists_;  // hashes, by design
  std::mutex mutex_;
  int broken_ = 0;
  std::set<std::size_t> broken_designs_;
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
      app.add_flag("--pin", options.pin, "write the figures into the pinned file instead of comparing")
          ->excludes(quick)
          ->excludes(cells);
  app.add_flag("--check", options.check, "measure nothing: only look whether what is asked for can be");
  app.add_option("--seeds", options.seeds, "of placement")->check(CLI::Range(1, 999))->capture_default_str();
  app.add_option("--jobs", options.jobs, "at a time")->check(CLI::Range(1, 999))->capture_default_str();
  // The rows would be incomplete.
  evidence::add_option(app, options.mode)->excludes(quick)->excludes(cells);
  app.add_option("--page", options.page, "page of the rows")->capture_default_str();
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

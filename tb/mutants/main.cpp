// SPDX-License-Identifier: Apache-2.0
// halfway_mutants: puts faults into the netlists of the entities and into the sources, and counts which of
// them the vectors and testbenches find.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <mutex>
#include <optional>
#include <set>

#include "evidence/measured.hpp"
#include "mutants/design.hpp"
#include "mutants/netlist_faults.hpp"
#include "mutants/replay.hpp"
#include "mutants/rows.hpp"
#include "mutants/source_faults.hpp"
#include "sim/os/command_line.hpp"
#include "sim/os/must.hpp"
#include "sim/os/seconds.hpp"
#include "sim/os/threads.hpp"

namespace halfway::mutants {
namespace {

using Clock = std::chrono::steady_clock;

// Limit of one proof. The quick form has a longer one, so that a busy machine does not change its result.
constexpr std::chrono::seconds c_proof_time{5}, c_quick_proof_time{60};
constexpr unsigned c_fewest = 25;     // faults that a row is of, if the netlist has so many
constexpr unsigned c_quick_step = 8;  // the quick form replays every eighth fault

struct Options {
  std::filesystem::path source, vectors, scratch;
  bool evidence = false;  ///< store rows of all faults of the step, and write the page
  std::string part;       ///< only netlists and testbenches whose name contains it
  unsigned jobs = 1, seed = 1;
  unsigned step = 1;      ///< replay every step-th fault of each netlist
  std::uint32_t one = 0;  ///< the number of the only fault; 0: all
  bool prove = true, netlists = true, sources = true, quick = false;
};

enum class End { found, equivalent, survived };

struct Outcome {
  Fault fault;
  std::uint32_t number;  ///< value of `mutsel` that selects the fault
  End end;
  std::string difference{};
};

struct NetlistResult {
  std::vector<Outcome> outcomes;
  unsigned step = 1;  ///< every step-th fault was replayed
  double seconds = 0;
  std::size_t count(End end) const {
    return static_cast<std::size_t>(
        std::count_if(outcomes.begin(), outcomes.end(), [&](const Outcome& o) { return o.end == end; }));
  }
};

std::string name_of(const SourceFault& fault) {
  return fault.file + ": " + (fault.in_vectors ? fmt::format("line {}", fault.line) : fault.new_text);
}

std::string to_string(const Outcome& outcome) {
  return fmt::format("{} {} {} {}", outcome.number, outcome.fault.kind, outcome.fault.port,
                     outcome.fault.wire);
}

std::string to_string(TestEnd end) {
  switch (end) {
    case TestEnd::passes:
      return "passes";
    case TestEnd::fails:
      return "fails";
    case TestEnd::unfinished:
      return "does not end in time";
  }
  return {};
}

NetlistResult run_netlist(const Options& options, const Design& design, const GhdlLibrary& library) {
  const auto start = Clock::now();
  const FaultyNetlist netlist = make_faulty_netlist(design, library, options.scratch, options.seed);
  const CompiledNetlist model = compile(design, netlist, options.source, options.scratch);
  const DesignVectors vectors = read_design_vectors(design, options.vectors);
  // Without a fault all outputs must be equal.
  if (const auto difference = replay(design, vectors, model, 0))
    throw Failure{{ExitCode::differs, fmt::format("{}: without a fault: {}", design.name, *difference)}};
  NetlistResult result;
  result.step = options.step;
  // A row is of some faults at least.
  if (options.evidence)
    result.step =
        std::min(options.step, std::max(1U, static_cast<unsigned>(netlist.faults.size() / c_fewest)));
  if (options.one > netlist.faults.size())
    throw Failure{bad_input(fmt::format("--one: {} has no fault {}; take 1 to {}", design.name, options.one,
                                        netlist.faults.size()))};
  std::vector<std::uint32_t> survivors;
  for (std::uint32_t number = 1; number <= netlist.faults.size(); ++number) {
    const Fault& fault = netlist.faults[number - 1];
    // Skip faults of clocks: a replay has no time between edges, in which an inverted clock would be visible.
    if (fault.port == "CLK" || !fault.changes || (options.one != 0 && number != options.one)) continue;
    if (number % result.step != 0) continue;
    const auto difference = replay(design, vectors, model, number);
    result.outcomes.push_back(
        {fault, number, difference ? End::found : End::survived, difference.value_or(std::string())});
    if (!difference) survivors.push_back(number);
  }
  if (options.prove && design.proofs) {
    const auto proved =
        prove_equivalent(netlist, survivors, options.quick ? c_quick_proof_time : c_proof_time);
    for (Outcome& outcome : result.outcomes) {
      const auto at = std::ranges::find(survivors, outcome.number);
      if (at != survivors.end() && proved[static_cast<std::size_t>(at - survivors.begin())])
        outcome.end = End::equivalent;
    }
  }
  result.seconds = seconds_since(start);
  return result;
}

std::string row_name(const std::string& test) {
  return "sources of " + test;
}

page::Row row_of(const Design& design, const NetlistResult& result, const Reasons& reasons) {
  page::Row row{.name = design.name, .section = std::string(c_netlist_section)};
  const auto count = [&](End end) { return std::to_string(result.count(end)); };
  row.fields = {{"netlist", "`" + design.name + "`"},
                {"replayed", result.step == 1 ? "all" : fmt::format("1 of {}", result.step)},
                {"faults", std::to_string(result.outcomes.size())},
                {"found", count(End::found)},
                {"equivalent", count(End::equivalent)},
                {"survived", count(End::survived)},
                {"seconds", fmt::format("{:.0f}", result.seconds)}};
  std::map<std::string, NetlistResult> kinds;
  for (const Outcome& outcome : result.outcomes) kinds[outcome.fault.kind].outcomes.push_back(outcome);
  for (const auto& [kind, part] : kinds)
    row.details +=
        fmt::format("{}\t{}\t{}\t{}\t{}\t{}\n", c_kind, kind, part.outcomes.size(), part.count(End::found),
                    part.count(End::equivalent), part.count(End::survived));
  for (const Outcome& outcome : result.outcomes)
    if (outcome.end == End::survived)
      row.details +=
          fmt::format("{}\t{}\t{}\n", c_survivor, reasons.line_at(outcome.fault.place), to_string(outcome));
  return row;
}

class Run {
 public:
  explicit Run(const Options& options)
      : options_(options),
        reasons_(options.source),
        designs_(read_designs(options.source)),
        faults_(read_source_faults(options.source / "tb/mutants/source_faults.toml")) {
    if (options_.evidence) measured_ = open_page();
    const auto is_left_out = [&](const std::string& name, const std::string& row, bool quick) {
      return name.find(options_.part) == std::string::npos || (options_.quick && !quick) ||
             (measured_ && measured_->has(row));
    };
    std::erase_if(designs_, [&](const Design& d) { return is_left_out(d.name, d.name, d.quick); });
    std::erase_if(faults_,
                  [&](const SourceFault& f) { return is_left_out(f.test, row_name(f.test), f.quick); });
  }

  ExitCode all() {
    if (options_.netlists) run_netlists();
    if (options_.sources) run_sources();
    return judge();
  }

 private:
  page::Measured open_page() const {
    std::vector<std::string> rows;
    for (const Design& design : designs_) rows.push_back(design.name);
    std::set<std::string> tests;
    for (const SourceFault& fault : faults_) tests.insert(row_name(fault.test));
    rows.insert(rows.end(), tests.begin(), tests.end());
    return page::Measured(
        {.name = "mutants",
         .root = options_.source,
         .file = "docs/results/mutants.md",
         .tools = {"ghdl", "yosys", "verilator"},
         .rows = std::move(rows),
         .sections = [this](std::span<const page::Row> of) { return mutant_sections(of, reasons_); },
         .values = mutant_values});
  }

  void store(const page::Row& row) const {
    if (measured_) measured_->put(row);
  }

  void run_netlists() {
    const GhdlTool tool = must(GhdlTool::find());
    const GhdlLibrary library =
        must(GhdlLibrary::for_synthesis(tool, must(read_rtl_sources(options_.source)), options_.scratch));
    page::Countdown countdown(designs_.size());
    must_for_each(options_.jobs, designs_.size(), [&](std::size_t i) {
      const Design& design = designs_[i];
      NetlistResult result = run_netlist(options_, design, library);
      const std::scoped_lock lock(mutex_);
      fmt::print("{} ", countdown.next());
      print(design.name, result);
      store(row_of(design, result, reasons_));
      netlists_[design.name] = std::move(result);
    });
  }

  void print(const std::string& name, const NetlistResult& result) const {
    fmt::print("{}: {} faults, {} found, {} equivalent, {} survived, {:.1f} s\n", name,
               result.outcomes.size(), result.count(End::found), result.count(End::equivalent),
               result.count(End::survived), result.seconds);
    for (const Outcome& outcome : result.outcomes)
      if (outcome.end == End::survived || options_.one != 0)
        fmt::print("  {} ({}){}{}\n", to_string(outcome), outcome.fault.place,
                   outcome.difference.empty() ? "" : ": ", outcome.difference);
    std::fflush(stdout);
  }

  void run_sources() {
    std::map<std::string, std::vector<SourceFault>> of_tests;
    for (const SourceFault& fault : faults_) of_tests[fault.test].push_back(fault);
    const std::vector<std::pair<std::string, std::vector<SourceFault>>> tests(of_tests.begin(),
                                                                              of_tests.end());
    must_for_each(options_.jobs, tests.size(),
                  [&](std::size_t i) { run_testbenches(tests[i].first, tests[i].second); });
  }

  /// Without a fault the testbench must pass, with each fault it must fail.
  void run_testbenches(const std::string& test, const std::vector<SourceFault>& faults) {
    std::size_t found = 0;
    const bool passes = ends(TestEnd::passes, {.test = test}, "no fault");
    for (const SourceFault& fault : faults) found += ends(TestEnd::fails, fault, name_of(fault));
    const std::scoped_lock lock(mutex_);
    sources_ += faults.size();
    sources_found_ += found;
    if (!passes || found < faults.size()) return;
    const std::string count = std::to_string(found);
    store({.name = row_name(test),
           .section = std::string(c_source_section),
           .fields = {{"testbench", "`" + test + "_tb`"}, {"faults", count}, {"found", count}}});
  }

  bool ends(TestEnd wanted, const SourceFault& fault, const std::string& name) {
    const auto start = Clock::now();
    const TestEnd end = run_testbench(fault, options_.source, options_.vectors, options_.scratch);
    const std::string what = fmt::format("{}: {}_tb {}", name, fault.test, to_string(end));
    const std::scoped_lock lock(mutex_);
    fmt::print("{}, {:.1f} s\n", what, seconds_since(start));
    std::fflush(stdout);
    if (end != wanted) missed_.push_back(what);
    return end == wanted;
  }

  /// Prints all faults, writes the page if rows were stored, and returns the exit code.
  ExitCode judge() {
    std::vector<std::string> wrong = missed_;
    std::size_t found = 0;
    for (const auto& [name, result] : netlists_) {
      found += result.count(End::found);
      for (const Outcome& outcome : result.outcomes)
        if (options_.quick && outcome.end == End::survived &&
            reasons_.of(reasons_.line_at(outcome.fault.place), name).empty())
          wrong.push_back(
              fmt::format("{}: fault {} ({}) survives; improve the vectors or give the reason in "
                          "tb/mutants/survivors.toml",
                          name, to_string(outcome), outcome.fault.place));
    }
    if (!netlists_.empty() && found == 0 && options_.one == 0 && !options_.evidence)
      wrong.emplace_back("no fault of any netlist is found");
    if (options_.sources) fmt::print("sources: {} faults, {} found\n", sources_, sources_found_);
    for (const std::string& what : wrong) fmt::print("{}\n", what);
    if (!wrong.empty()) return ExitCode::differs;
    return measured_ ? measured_->finish() : ExitCode::equal;
  }

  const Options& options_;
  const Reasons reasons_;
  std::vector<Design> designs_;
  std::vector<SourceFault> faults_;
  std::optional<page::Measured> measured_;
  std::mutex mutex_;
  std::map<std::string, NetlistResult> netlists_;
  std::size_t sources_ = 0, sources_found_ = 0;
  std::vector<std::string> missed_;
};

}  // namespace
}  // namespace halfway::mutants

int main(int argc, char** argv) {
  using namespace halfway;
  mutants::Options options;
  CLI::App app{"Puts faults into the hardware, which the tests must find", "halfway_mutants"};
  CLI::Option* quick = app.add_flag("--quick", options.quick, "a sample: a few small netlists and sources");
  CLI::Option* seed = app.add_option("--seed", options.seed, "selects other faults")->capture_default_str();
  CLI::Option* step = app.add_option("--step", options.step, "replay only every N-th fault of a netlist")
                          ->check(CLI::PositiveNumber)
                          ->excludes(quick);
  app.add_option("--jobs", options.jobs, "at a time")->check(CLI::PositiveNumber)->capture_default_str();
  CLI::Option* one = app.add_option("--one", options.one, "only the fault of this number, with what finds it")
                         ->check(CLI::PositiveNumber)
                         ->excludes(quick, step);
  CLI::Option* no_proofs =
      app.add_flag("--no-proofs{false}", options.prove, "do not try to prove survivors equivalent");
  app.add_flag("--no-sources{false}", options.sources, "netlists alone");
  app.add_flag("--no-netlists{false}", options.netlists, "source faults alone")->excludes(one);
  app.add_option("SOURCE", options.source, "the project's root")->required();
  app.add_option("VECTORS", options.vectors, "what halfway_vectors wrote")->required();
  app.add_option("SCRATCH", options.scratch, "folder for netlists and what is built from them")->required();
  app.add_option("PART", options.part, "only netlists and testbenches whose names hold it");
  // A row is of the usual seed, with proofs.
  app.add_flag("--evidence", options.evidence, "measure the rows that are missing, and write the page")
      ->excludes(quick, one, seed, no_proofs);
  int exit_code = 0;
  app.callback([&] {
    for (auto* folder : {&options.source, &options.vectors, &options.scratch})
      *folder = std::filesystem::absolute(*folder);
    if (options.quick) options.step = mutants::c_quick_step;
    if (options.one != 0) options.sources = false;
    exit_code = static_cast<int>(mutants::Run(options).all());
  });
  return cli::run_program(app, argc, argv, exit_code);
}

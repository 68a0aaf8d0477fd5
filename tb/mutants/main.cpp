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
#include <sstream>

#include "mutants/design.hpp"
#include "mutants/netlist_faults.hpp"
#include "mutants/replay.hpp"
#include "mutants/source_faults.hpp"
#include "page/page.hpp"
#include "sim/pages/template.hpp"
#include "sim/program/program.hpp"
#include "sim/system/file.hpp"
#include "sim/system/threads.hpp"

namespace halfway::mutants {
namespace {

using Clock = std::chrono::steady_clock;

// Limit of one proof. The quick form has a longer one, so that a busy machine does not change its result.
constexpr std::chrono::seconds c_proof_time{2}, c_quick_proof_time{60};
constexpr unsigned c_quick_step = 8;  // the quick form replays every eighth fault
constexpr std::size_t c_shown = 3;    // survivors of a VHDL line that the page names

struct Options {
  std::filesystem::path source, vectors, scratch, page;
  std::string part;  ///< only netlists and testbenches whose name contains it
  unsigned jobs = 1, seed = 1;
  unsigned step = 1;      ///< replay one of so many faults of each netlist
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

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Result<NetlistResult> run_netlist(const Options& options, const Design& design, const GhdlLibrary& library) {
  const auto start = Clock::now();
  const auto netlist = make_faulty_netlist(design, library, options.scratch, options.seed);
  if (!netlist) return netlist.error();
  const auto model = compile(design, *netlist, options.source, options.scratch);
  if (!model) return model.error();
  const auto vectors = read_design_vectors(design, options.vectors);
  if (!vectors) return vectors.error();
  // Without a fault all outputs must be equal.
  if (const auto difference = replay(design, *vectors, *model, 0))
    return Error{ExitCode::differs, fmt::format("{}: without a fault: {}", design.name, *difference)};
  NetlistResult result;
  std::vector<std::uint32_t> survivors;
  for (std::uint32_t number = 1; number <= netlist->faults.size(); ++number) {
    const Fault& fault = netlist->faults[number - 1];
    // Skip faults of clocks: a replay has no time between edges, in which an inverted clock would be visible.
    if (fault.port == "CLK" || (options.one != 0 && number != options.one)) continue;
    if (number % options.step != 0) continue;
    const auto difference = replay(design, *vectors, *model, number);
    result.outcomes.push_back(
        {fault, number, difference ? End::found : End::survived, difference.value_or(std::string())});
    if (!difference) survivors.push_back(number);
  }
  if (options.prove) {
    const auto proved =
        prove_equivalent(*netlist, survivors, options.quick ? c_quick_proof_time : c_proof_time);
    if (!proved) return proved.error();
    for (Outcome& outcome : result.outcomes) {
      const auto at = std::find(survivors.begin(), survivors.end(), outcome.number);
      if (at != survivors.end() && (*proved)[static_cast<std::size_t>(at - survivors.begin())])
        outcome.end = End::equivalent;
    }
  }
  result.seconds = seconds_since(start);
  return result;
}

/// The reasons for survivors, by file and text of the VHDL line: survivors.toml.
class Reasons {
 public:
  static Result<Reasons> read(const std::filesystem::path& source) {
    const auto listed = read_survivors(source / "tb/mutants/survivors.toml");
    if (!listed) return listed.error();
    return Reasons(source, *listed);
  }
  /// The reason for survivors of the line `place` ("file:line"); empty if there is none.
  std::string of(const std::string& place) {
    const std::string text = text_of(place);
    for (const Survivor& survivor : listed_)
      if (place.starts_with(survivor.file + ":") && text.find(survivor.text) != std::string::npos)
        return survivor.reason;
    return {};
  }

 private:
  Reasons(std::filesystem::path source, std::vector<Survivor> listed)
      : source_(std::move(source)), listed_(std::move(listed)) {}
  std::string text_of(const std::string& place) {
    const auto colon = place.find(':');
    if (colon == std::string::npos) return {};
    const auto text = read_file(source_ / "rtl" / place.substr(0, colon));
    if (!text) return {};
    std::istringstream lines(*text);
    std::string line;
    for (int number = std::stoi(place.substr(colon + 1)); number > 0 && std::getline(lines, line); --number)
      continue;
    return line;
  }
  std::filesystem::path source_;
  std::vector<Survivor> listed_;
};

class Run {
 public:
  explicit Run(const Options& options) : options_(options) {}

  ExitCode all() {
    if (options_.netlists)
      if (const Status done = run_netlists(); !done) return fail(done.error());
    if (options_.sources)
      if (const Status done = run_sources(); !done) return fail(done.error());
    return judge();
  }

 private:
  static ExitCode fail(const Error& error) {
    fmt::print(stderr, "{}\n", error.message);
    return error.code;
  }

  Status run_netlists() {
    const auto tool = GhdlTool::find();
    if (!tool) return tool.error();
    const auto sources = read_rtl_sources(options_.source);
    if (!sources) return sources.error();
    const auto library = GhdlLibrary::for_synthesis(*tool, *sources, options_.scratch);
    if (!library) return library.error();
    auto designs = read_designs(options_.source / "tb/mutants/designs.toml");
    if (!designs) return designs.error();
    std::erase_if(*designs, [&](const Design& d) {
      return d.name.find(options_.part) == std::string::npos || (options_.quick && !d.quick);
    });
    return for_each_on_threads(options_.jobs, designs->size(), [&](std::size_t i) -> Status {
      auto result = run_netlist(options_, (*designs)[i], *library);
      if (!result) return result.error();
      const std::scoped_lock lock(mutex_);
      print((*designs)[i].name, *result);
      netlists_[(*designs)[i].name] = std::move(*result);
      return Ok{};
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

  Status run_sources() {
    auto faults = read_source_faults(options_.source / "tb/mutants/source_faults.toml");
    if (!faults) return faults.error();
    std::erase_if(*faults, [&](const SourceFault& f) {
      return f.test.find(options_.part) == std::string::npos || (options_.quick && !f.quick);
    });
    // Without a fault each testbench must pass.
    std::map<std::string, SourceFault> tests;
    for (const SourceFault& fault : *faults) tests[fault.test].test = fault.test;
    std::vector<SourceFault> all;
    for (const auto& [name, test] : tests) all.push_back(test);
    const std::size_t count = all.size();
    all.insert(all.end(), faults->begin(), faults->end());
    return for_each_on_threads(options_.jobs, all.size(), [&](std::size_t i) -> Status {
      const auto start = Clock::now();
      const auto end = run_testbench(all[i], options_.source, options_.vectors, options_.scratch);
      if (!end) return end.error();
      const std::string how = *end == TestEnd::passes  ? "passes"
                              : *end == TestEnd::fails ? "fails"
                                                       : "does not end in time";
      const std::string what =
          fmt::format("{}: {}_tb {}", i < count ? "no fault" : name_of(all[i]), all[i].test, how);
      const std::scoped_lock lock(mutex_);
      fmt::print("{}, {:.1f} s\n", what, seconds_since(start));
      std::fflush(stdout);
      const bool right = *end == (i < count ? TestEnd::passes : TestEnd::fails);
      if (!right) missed_.push_back(what);
      if (i < count) return Ok{};
      ++sources_;
      sources_found_ += right;
      return Ok{};
    });
  }

  /// Prints all faults, writes the page if requested, and returns the exit code.
  ExitCode judge() {
    auto reasons = Reasons::read(options_.source);
    if (!reasons) return fail(reasons.error());
    std::vector<std::string> wrong = missed_;
    std::size_t found = 0;
    for (const auto& [name, result] : netlists_) {
      found += result.count(End::found);
      for (const Outcome& outcome : result.outcomes)
        if (options_.quick && outcome.end == End::survived && reasons->of(outcome.fault.place).empty())
          wrong.push_back(
              fmt::format("{}: fault {} ({}) survives; improve the vectors or give the reason in "
                          "tb/mutants/survivors.toml",
                          name, to_string(outcome), outcome.fault.place));
    }
    if (!netlists_.empty() && found == 0 && options_.one == 0)
      wrong.emplace_back("no fault of any netlist is found");
    if (options_.sources) fmt::print("sources: {} faults, {} found\n", sources_, sources_found_);
    for (const std::string& what : wrong) fmt::print("{}\n", what);
    if (!options_.page.empty())
      if (const Status written = write_page(*reasons); !written) return fail(written.error());
    return wrong.empty() ? ExitCode::equal : ExitCode::differs;
  }

  /// One sentence for the page.
  std::string what_was_run() const {
    return fmt::format(
        "This run replayed {} of each netlist (seed {}){}.\n",
        options_.step == 1 ? "all faults" : fmt::format("a sample, every {}th fault,", options_.step),
        options_.seed, options_.prove ? "" : " and did not try to prove that survivors are equivalent");
  }

  Status write_page(Reasons& reasons) const {
    using Row = std::vector<std::string>;
    NetlistResult all;
    std::vector<Row> rows, kind_rows, survivor_rows;
    std::map<std::string, NetlistResult> kinds;
    std::map<std::pair<std::string, std::string>, std::vector<std::string>> survivors;
    const auto row_of = [](const std::string& name, const NetlistResult& r) {
      return Row{name, std::to_string(r.outcomes.size()), std::to_string(r.count(End::found)),
                 std::to_string(r.count(End::equivalent)), std::to_string(r.count(End::survived))};
    };
    for (const auto& [name, result] : netlists_) {
      rows.push_back(row_of("`" + name + "`", result));
      rows.back().push_back(fmt::format("{:.0f}", result.seconds));
      all.seconds += result.seconds;
      for (const Outcome& outcome : result.outcomes) {
        all.outcomes.push_back(outcome);
        kinds[outcome.fault.kind].outcomes.push_back(outcome);
        if (outcome.end == End::survived)
          survivors[{outcome.fault.place, name}].push_back(to_string(outcome));
      }
    }
    rows.push_back(row_of("**all**", all));
    rows.back().push_back(fmt::format("{:.0f}", all.seconds));
    for (const auto& [kind, result] : kinds) kind_rows.push_back(row_of(kind, result));
    for (const auto& [at, texts] : survivors) {
      std::string shown;
      for (std::size_t i = 0; i < std::min(texts.size(), c_shown); ++i)
        shown += (i == 0 ? "" : "; ") + texts[i];
      if (texts.size() > c_shown) shown += fmt::format("; {} more", texts.size() - c_shown);
      survivor_rows.push_back({at.first.empty() ? "not known" : "`" + at.first + "`", "`" + at.second + "`",
                               std::to_string(texts.size()), "`" + shown + "`", reasons.of(at.first)});
    }
    const std::size_t possible = all.outcomes.size() - all.count(End::equivalent);
    const Row columns{"netlist", "faults", "found", "equivalent", "survived", "seconds"};
    const Row kind_columns{"kind", "faults", "found", "equivalent", "survived"};
    const Row survivor_columns{"VHDL line", "netlist", "faults", "number, kind, port, wire", "reason"};
    const std::vector<page::Section> sections{
        {"Netlist faults", fmt::format("{}\n{}\nOf the {} faults that are not proved equivalent, the vectors "
                                       "find {:.1f} %. Seconds are "
                                       "those of a run with {} jobs.\n\n{}",
                                       what_was_run(), markdown_table(columns, rows), possible,
                                       100.0 * static_cast<double>(all.count(End::found)) /
                                           static_cast<double>(std::max<std::size_t>(possible, 1)),
                                       options_.jobs, markdown_table(kind_columns, kind_rows))},
        {"Source faults", fmt::format("Of {} faults in sources and vector files, the testbenches find {}.\n",
                                      sources_, sources_found_)},
        {"Survivors", markdown_table(survivor_columns, survivor_rows)}};
    return page::write_sections(options_.page, sections);
  }

  const Options& options_;
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
  app.add_option("--seed", options.seed, "selects other faults")->capture_default_str();
  CLI::Option* step = app.add_option("--step", options.step, "only every so many faults of a netlist")
                          ->check(CLI::PositiveNumber)
                          ->excludes(quick);
  app.add_option("--jobs", options.jobs, "at a time")->check(CLI::PositiveNumber)->capture_default_str();
  CLI::Option* one = app.add_option("--one", options.one, "only the fault of this number, with what finds it")
                         ->check(CLI::PositiveNumber)
                         ->excludes(quick, step);
  app.add_flag("--no-proofs{false}", options.prove, "do not try to prove survivors equivalent");
  CLI::Option* no_sources = app.add_flag("--no-sources{false}", options.sources, "netlists alone");
  CLI::Option* no_netlists =
      app.add_flag("--no-netlists{false}", options.netlists, "source faults alone")->excludes(one);
  app.add_option("SOURCE", options.source, "the project's root")->required();
  app.add_option("VECTORS", options.vectors, "what halfway_vectors wrote")->required();
  app.add_option("SCRATCH", options.scratch, "folder for netlists and what is built from them")->required();
  CLI::Option* part =
      app.add_option("PART", options.part, "only netlists and testbenches whose names hold it");
  app.add_option("--page", options.page, "file whose tables are written")
      ->excludes(quick, one, part, no_sources, no_netlists);
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

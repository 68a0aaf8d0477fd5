// SPDX-License-Identifier: Apache-2.0
// halfway_proofs: proves the properties of the RTL. Each fault of a proof goes into a copy of the RTL, and
// the proof must refute it. Each proof is a row of docs/results/proofs.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "evidence/measured.hpp"
#include "proof_files.hpp"
#include "prover.hpp"
#include "sim/os/command_line.hpp"
#include "sim/os/must.hpp"
#include "sim/os/seconds.hpp"
#include "sim/os/threads.hpp"
#include "text.hpp"

namespace halfway::proofs {
namespace {

constexpr std::size_t c_few_faults = 4;  // of each proof on the page; all take longer than all proofs
constexpr unsigned c_threads = 2;

struct Options {
  bool faults = true;
  bool quick = false, slow = false;
  bool evidence = false;
  Folders folders{};
  std::string name{};
};

// ---- Which proofs

// Keeps faults at equal distances.
void keep_few(std::vector<Fault>& faults) {
  const std::size_t count = faults.size();
  if (count <= c_few_faults) return;
  for (std::size_t i = 0; i < c_few_faults; ++i) faults[i] = faults[i * count / c_few_faults];
  faults.resize(c_few_faults);
}

bool is_selected(const Options& options, const Proof& proof) {
  return (proof.quick ? !options.slow : !options.quick) &&
         (contains(proof.unit, options.name) || contains(proof.name, options.name));
}

std::vector<Proof> select_proofs(const Options& options, std::vector<Proof> proofs) {
  std::erase_if(proofs, [&](const Proof& proof) { return !is_selected(options, proof); });
  if (proofs.empty())
    throw Failure{bad_input(fmt::format("{}: no proof has this in its name", options.name))};
  for (Proof& proof : proofs) {
    if (!options.faults) proof.faults.clear();
    if (options.evidence) keep_few(proof.faults);
  }
  return proofs;
}

void check_faults(const Options& options, const std::vector<Proof>& proofs) {
  for (const Proof& proof : proofs) {
    const auto rtl = read_sources(options.folders, proof);
    for (const Fault& fault : proof.faults) text_with_fault(rtl, fault);
  }
}

// ---- Running them

// One proof, or one fault of it.
struct Job {
  std::size_t proof;
  const Fault* fault;  // null: the proof itself
};

std::vector<Job> jobs_of(const std::vector<Proof>& proofs) {
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < proofs.size(); ++i) {
    jobs.push_back({i, nullptr});
    for (const Fault& fault : proofs[i].faults) jobs.push_back({i, &fault});
  }
  return jobs;
}

struct Outcome {
  bool holds = false;
  int refuted = 0;     // faults
  double seconds = 0;  // of the proof, without its faults
  int remaining = 0;   // jobs
};

struct Outcomes {
  std::vector<Outcome> proofs;
  int not_proved = 0;
  int not_refuted = 0;  // faults
  int broken = 0;       // jobs without an answer
};

void record(const Proof& proof, const Job& job, const Result<Answer>& answer, double seconds,
            Outcomes& outcomes) {
  Outcome& outcome = outcomes.proofs[job.proof];
  if (!answer) {
    ++outcomes.broken;
    fmt::print("{}\n", answer.error().message);
  } else if (job.fault == nullptr) {
    outcome.holds = answer->verdict == Verdict::holds;
    outcome.seconds = seconds;
    if (!outcome.holds) ++outcomes.not_proved;
    fmt::print("{}: {}: {} ({:.1f} s)\n", proof.unit, proof.property,
               outcome.holds ? "proved" : "NOT PROVED: " + answer->reason, seconds);
  } else if (answer->verdict == Verdict::refuted) {
    ++outcome.refuted;
    fmt::print("{}: refutes `{}` ({:.1f} s)\n", proof.unit, job.fault->new_text, seconds);
  } else {
    ++outcomes.not_refuted;
    fmt::print("{}: {}: does NOT refute `{}` for `{}` {}\n", job.fault->where, proof.unit,
               job.fault->new_text, job.fault->old_text, answer->reason);
  }
  std::fflush(stdout);
}

// Calls `done` for each proof after its last job.
template <class Done>
Outcomes run_jobs(const Folders& folders, const std::vector<Proof>& proofs, const Done& done) {
  const std::vector<Job> jobs = jobs_of(proofs);
  Outcomes outcomes{.proofs = std::vector<Outcome>(proofs.size())};
  for (const Job& job : jobs) ++outcomes.proofs[job.proof].remaining;
  std::atomic<std::size_t> next = 0;
  page::Countdown countdown(jobs.size());
  std::mutex mutex;
  work_on_threads(c_threads, [&] {
    for (std::size_t at; (at = next++) < jobs.size();) {
      const Job& job = jobs[at];
      const Proof& proof = proofs[job.proof];
      const auto began = std::chrono::steady_clock::now();
      const auto answer = caught([&] { return prove(folders, proof, job.fault); });
      const double seconds = seconds_since(began);
      const std::lock_guard lock(mutex);
      fmt::print("{} ", countdown.next());
      record(proof, job, answer, seconds, outcomes);
      if (--outcomes.proofs[job.proof].remaining == 0) done(proof, outcomes.proofs[job.proof]);
    }
  });
  return outcomes;
}

// ---- The page

std::string_view name_on_page(Method method) {
  switch (method) {
    case Method::induction:
      return "induction";
    case Method::bounded:
    case Method::bounded_abc:
      return "BMC";
    case Method::pdr:
      return "PDR";
    case Method::gappa:
      return "Gappa";
  }
  return "";
}

// The row of a proof that holds and refutes all its faults.
page::Row row_of(const Proof& proof, const Outcome& outcome) {
  return {.name = proof.name,
          .section = "Results",
          .fields = {{"property", proof.property},
                     {"entity", fmt::format("`{}`", proof.entity)},
                     {"method", std::string(name_on_page(proof.method))},
                     {"clocks", proof.clocks > 0 ? std::to_string(proof.clocks) : "all"},
                     {"seconds", fmt::format("{:.1f}", outcome.seconds)},
                     {"faults refuted", fmt::format("{} of {}", outcome.refuted, proof.faults.size())}}};
}

page::Measured open_page(const Options& options, const std::vector<Proof>& proofs) {
  std::vector<std::string> rows;
  for (const Proof& proof : proofs) rows.push_back(proof.name);
  return page::Measured({.name = "proofs",
                         .root = options.folders.source,
                         .file = "docs/results/proofs.md",
                         .tools = {"ghdl", "yosys", "cvc5", "gappa"},
                         .rows = std::move(rows)});
}

// ---- The program

ExitCode prove_all(const Options& options) {
  const std::vector<Proof> all = read_proofs(options.folders.source);
  std::vector<Proof> proofs = select_proofs(options, all);
  check_faults(options, proofs);
  find_tools();
  std::optional<page::Measured> measured;
  if (options.evidence) {
    measured = open_page(options, all);
    std::erase_if(proofs, [&](const Proof& proof) { return measured->has(proof.name); });
  }
  const auto store = [&](const Proof& proof, const Outcome& outcome) {
    if (measured && outcome.holds && static_cast<std::size_t>(outcome.refuted) == proof.faults.size())
      measured->put(row_of(proof, outcome));
  };
  const Outcomes outcomes = run_jobs(options.folders, proofs, store);
  fmt::print("\n{} of {} not proved, {} faults not refuted, {} could not be run\n", outcomes.not_proved,
             proofs.size(), outcomes.not_refuted, outcomes.broken);
  if (outcomes.not_proved + outcomes.not_refuted > 0) return ExitCode::differs;
  if (outcomes.broken > 0) return ExitCode::tool_failed;
  return measured ? measured->finish() : ExitCode::equal;
}

}  // namespace
}  // namespace halfway::proofs

int main(int argc, char** argv) {
  using namespace halfway;
  proofs::Options options;
  CLI::App app{"Proves properties of the RTL, and checks that each proof refutes its faults",
               "halfway_proofs"};
  CLI::Option* quick = app.add_flag("--quick", options.quick, "only proofs that take a few seconds");
  CLI::Option* slow =
      app.add_flag("--slow", options.slow, "only the proofs that --quick leaves out")->excludes(quick);
  CLI::Option* no_faults = app.add_flag("--no-faults{false}", options.faults, "only the proofs");
  app.add_flag("--evidence", options.evidence,
               fmt::format(
                   "measure the rows that are missing, with {} faults of a proof at most, and write the page",
                   proofs::c_few_faults))
      ->excludes(quick, slow, no_faults);
  app.add_option("SOURCE", options.folders.source, "the project's root")->required();
  app.add_option("SCRATCH", options.folders.scratch, "folder for temporary files")->required();
  app.add_option("NAME", options.name, "only proofs with this in their names, such as raster/edge_walker");
  int exit_code = 0;
  app.callback([&] {
    options.folders.source = std::filesystem::absolute(options.folders.source);
    options.folders.scratch = std::filesystem::absolute(options.folders.scratch);
    exit_code = static_cast<int>(proofs::prove_all(options));
  });
  return cli::run_program(app, argc, argv, exit_code);
}

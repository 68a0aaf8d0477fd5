// SPDX-License-Identifier: Apache-2.0
// halfway_proofs: proves the properties of the RTL. Each fault of a proof goes into a copy of the RTL, and
// the proof must refute it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "page/page.hpp"
#include "proof_files.hpp"
#include "prover.hpp"
#include "sim/pages/template.hpp"
#include "sim/program/program.hpp"
#include "sim/system/seconds.hpp"
#include "sim/system/threads.hpp"
#include "text.hpp"

namespace halfway::proofs {
namespace {

constexpr std::size_t c_quick_faults = 4;  // per proof; all faults of a walker take longer than all proofs
constexpr unsigned c_threads = 2;

struct Options {
  bool faults = true;
  bool quick = false;
  std::filesystem::path page{};
  Folders folders{};
  std::string name{};
};

// ---- Which proofs

// Keeps faults at equal distances.
void keep_few(std::vector<Fault>& faults) {
  const std::size_t count = faults.size();
  if (count <= c_quick_faults) return;
  for (std::size_t i = 0; i < c_quick_faults; ++i) faults[i] = faults[i * count / c_quick_faults];
  faults.resize(c_quick_faults);
}

Result<std::vector<Proof>> select_proofs(const Options& options) {
  auto proofs = read_proofs(options.folders.source);
  if (!proofs) return proofs;
  std::erase_if(*proofs, [&](const Proof& proof) {
    return (options.quick && !proof.quick) || !contains(proof.unit, options.name);
  });
  if (proofs->empty()) return bad_input(fmt::format("{}: no proof has this in its name", options.name));
  for (Proof& proof : *proofs) {
    if (!options.faults) proof.faults.clear();
    if (options.quick) keep_few(proof.faults);
  }
  return proofs;
}

Status check_faults(const Options& options, const std::vector<Proof>& proofs) {
  const auto rtl = read_rtl_sources(options.folders.source);
  if (!rtl) return rtl.error();
  for (const Proof& proof : proofs)
    for (const Fault& fault : proof.faults)
      if (const auto text = text_with_fault(*rtl, fault); !text) return text.error();
  return Ok{};
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

Outcomes run_jobs(const Folders& folders, const std::vector<Proof>& proofs) {
  const std::vector<Job> jobs = jobs_of(proofs);
  Outcomes outcomes{.proofs = std::vector<Outcome>(proofs.size())};
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  work_on_threads(c_threads, [&] {
    for (std::size_t at; (at = next++) < jobs.size();) {
      const Job& job = jobs[at];
      const Proof& proof = proofs[job.proof];
      const auto began = std::chrono::steady_clock::now();
      const auto answer = prove(folders, proof, job.fault);
      const double seconds = seconds_since(began);
      const std::lock_guard lock(mutex);
      record(proof, job, answer, seconds, outcomes);
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

std::vector<std::string> row_of(const Proof& proof, const Outcome& outcome) {
  return {proof.property,
          fmt::format("`{}`", proof.entity),
          std::string(name_on_page(proof.method)),
          proof.clocks > 0 ? std::to_string(proof.clocks) : "all",
          fmt::format("{:.1f}", outcome.seconds),
          outcome.holds ? fmt::format("{} of {}", outcome.refuted, proof.faults.size()) : "not proved"};
}

std::string table_of(const std::vector<Proof>& proofs, const std::vector<Outcome>& outcomes) {
  const std::vector<std::string> columns = {"property", "entity",  "method",
                                            "clocks",   "seconds", "faults refuted"};
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < proofs.size(); ++i) rows.push_back(row_of(proofs[i], outcomes[i]));
  return markdown_table(columns, rows);
}

// ---- The program

Result<ExitCode> prove_all(const Options& options) {
  const auto proofs = select_proofs(options);
  if (!proofs) return proofs.error();
  if (auto checked = check_faults(options, *proofs); !checked) return checked.error();
  if (auto found = find_tools(); !found) return found.error();
  const Outcomes outcomes = run_jobs(options.folders, *proofs);
  const std::string table = table_of(*proofs, outcomes.proofs);
  fmt::print("\n{}\n{} of {} not proved, {} faults not refuted, {} could not be run\n", table,
             outcomes.not_proved, proofs->size(), outcomes.not_refuted, outcomes.broken);
  if (outcomes.not_proved + outcomes.not_refuted > 0) return ExitCode::differs;
  if (outcomes.broken > 0) return ExitCode::tool_failed;
  if (!options.page.empty())
    if (auto written = page::write_sections(options.page, std::array{page::Section{"Results", table}});
        !written)
      return written.error();
  return ExitCode::equal;
}

}  // namespace
}  // namespace halfway::proofs

int main(int argc, char** argv) {
  using namespace halfway;
  proofs::Options options;
  CLI::App app{"Proves properties of the RTL, and checks that each proof refutes its faults",
               "halfway_proofs"};
  CLI::Option* quick =
      app.add_flag("--quick", options.quick,
                   fmt::format("only proofs that take a few seconds, each with {} faults at most",
                               proofs::c_quick_faults));
  CLI::Option* no_faults = app.add_flag("--no-faults{false}", options.faults, "only the proofs");
  CLI::Option* page =
      app.add_option("--page", options.page, "page whose table is replaced; needs all proofs and faults");
  app.add_option("SOURCE", options.folders.source, "the project's root")->required();
  app.add_option("SCRATCH", options.folders.scratch, "folder for temporary files")->required();
  CLI::Option* name = app.add_option("NAME", options.name,
                                     "only proofs with this in their names, such as raster/edge_walker");
  page->excludes(quick, no_faults, name);
  int exit_code = 0;
  app.callback([&] {
    options.folders.source = std::filesystem::absolute(options.folders.source);
    options.folders.scratch = std::filesystem::absolute(options.folders.scratch);
    const auto end = proofs::prove_all(options);
    exit_code = end ? static_cast<int>(*end) : cli::report(end.error());
  });
  return cli::run_program(app, argc, argv, exit_code);
}

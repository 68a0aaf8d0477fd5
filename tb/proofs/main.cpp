// SPDX-License-Identifier: Apache-2.0
// halfway_proofs: proves every property of the list on the RTL, and puts each of its faults into a copy,
// which must refute it.
#include <fmt/format.h>

#include <atomic>
#include <cstdio>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "prover.hpp"
#include "sim/program/program.hpp"
#include "sim/system/file.hpp"
#include "sim/system/seconds.hpp"
#include "sim/system/threads.hpp"

namespace halfway::proofs {
namespace {

constexpr std::size_t kQuickFaults = 4;  // of a proof; a walker's take longer than all proofs
constexpr std::string_view kTable =
    "| property | entity | method | clocks | seconds | faults refuted |\n| --- | --- | --- | --- | --- | --- "
    "|\n";

struct Options {
  bool faults = true;
  bool quick = false;
  std::filesystem::path page{};
  Folders folders{};
  std::string part{};
};

// What a proof and its faults came to.
struct Outcome {
  bool holds = false;
  int refuted = 0;
  double seconds = 0;  ///< of the proof alone
};

std::string in_page(const Proof& proof, const Outcome& outcome) {
  constexpr const char* names[] = {"induction", "BMC", "BMC", "PDR", "Gappa"};
  const bool clocks = proof.method != Method::pdr && proof.method != Method::gappa;
  return fmt::format(
      "| {} | `{}` | {} | {} | {:.1f} | {} |\n", proof.property, proof.entity,
      names[static_cast<int>(proof.method)], clocks ? std::to_string(proof.depth) : "all", outcome.seconds,
      outcome.holds ? fmt::format("{} of {}", outcome.refuted, proof.faults.size()) : "not proved");
}

Status write_page(const std::filesystem::path& path, std::string_view rows) {
  auto text = read_file(path);
  if (!text) return text.error();
  text->resize(std::min(text->find(kTable.substr(0, kTable.find('\n'))), text->size()));
  return write_file(path, fmt::format("{}{}{}", *text, kTable, rows));
}

ExitCode run(const Options& options, const std::vector<Proof>& proofs) {
  // Each job is a proof, or a fault of one.
  struct Job {
    std::size_t proof;
    const Fault* fault;
  };
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < proofs.size(); ++i) {
    jobs.push_back({i, nullptr});
    if (!options.faults) continue;
    for (const Fault& fault : proofs[i].faults) jobs.push_back({i, &fault});
  }
  std::vector<Outcome> outcomes(proofs.size());
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  int unproved = 0, missed = 0, broken = 0;
  const auto work = [&] {
    for (std::size_t at; (at = next++) < jobs.size();) {
      const auto [index, fault] = jobs[at];
      const Proof& proof = proofs[index];
      const auto began = std::chrono::steady_clock::now();
      const auto answer = prove(options.folders, proof, fault);
      const double seconds = seconds_since(began);
      const std::lock_guard lock(mutex);
      if (!answer) {
        ++broken;
        fmt::print("{}\n", answer.error().message);
      } else if (fault == nullptr) {
        outcomes[index].holds = answer->verdict == Verdict::holds;
        outcomes[index].seconds = seconds;
        unproved += answer->verdict == Verdict::holds ? 0 : 1;
        fmt::print("{}: {}: {} ({:.1f} s)\n", proof.unit, proof.property,
                   answer->verdict == Verdict::holds ? "proved" : "NOT PROVED: " + answer->said, seconds);
      } else if (answer->verdict == Verdict::refuted) {
        ++outcomes[index].refuted;
        fmt::print("{}: refutes `{}` ({:.1f} s)\n", proof.unit, fault->to, seconds);
      } else {
        ++missed;
        fmt::print("{}: does NOT refute `{}` for `{}` {}\n", proof.unit, fault->to, fault->from,
                   answer->said);
      }
      std::fflush(stdout);
    }
  };
  work_on_threads(2, work);
  std::string rows;
  for (std::size_t i = 0; i < proofs.size(); ++i) rows += in_page(proofs[i], outcomes[i]);
  fmt::print("\n{}{}\n{} of {} not proved, {} faults not refuted, {} could not be run\n", kTable, rows,
             unproved, proofs.size(), missed, broken);
  if (unproved + missed > 0) return ExitCode::differs;
  if (broken > 0) return ExitCode::tool_failed;
  if (options.page.empty()) return ExitCode::equal;
  const auto written = write_page(options.page, rows);
  if (written) return ExitCode::equal;
  fmt::print(stderr, "{}\n", written.error().message);
  return written.error().code;
}

// Evenly out of all.
void keep_few(std::vector<Fault>& faults) {
  const std::size_t all = faults.size();
  if (all <= kQuickFaults) return;
  for (std::size_t i = 0; i < kQuickFaults; ++i) faults[i] = faults[i * all / kQuickFaults];
  faults.resize(kQuickFaults);
}

int main_of(const Options& options) {
  std::vector<Proof> proofs;
  for (Proof& proof : all_proofs()) {
    if (options.quick && !proof.quick) continue;
    if (std::string_view(proof.unit).find(options.part) == std::string_view::npos) continue;
    if (options.quick) keep_few(proof.faults);
    proofs.push_back(std::move(proof));
  }
  if (proofs.empty()) {
    fmt::print(stderr, "{}: no proof is of an entity of this name\n", options.part);
    return static_cast<int>(ExitCode::bad_input);
  }
  if (const auto found = find_tools(); !found) {
    fmt::print(stderr, "{}\n", found.error().message);
    return static_cast<int>(found.error().code);
  }
  return static_cast<int>(run(options, proofs));
}

}  // namespace
}  // namespace halfway::proofs

int main(int argc, char** argv) {
  using namespace halfway;
  proofs::Options options;
  CLI::App app{"Proves properties of the RTL, and that each proof refutes the faults put in for it",
               "halfway_proofs"};
  app.add_flag("--quick", options.quick,
               fmt::format("proofs of a few seconds, each with {} faults at most", proofs::kQuickFaults));
  app.add_flag("--no-faults{false}", options.faults, "proofs alone");
  app.add_option("--page", options.page, "file whose table is written anew");
  app.add_option("SOURCE", options.folders.source, "the project's root")->required();
  app.add_option("SCRATCH", options.folders.scratch, "folder for temporary files")->required();
  app.add_option("PART", options.part, "only proofs of entities whose names hold it");
  int exit_code = 0;
  app.callback([&] {
    options.folders.source = std::filesystem::absolute(options.folders.source);
    options.folders.scratch = std::filesystem::absolute(options.folders.scratch);
    exit_code = proofs::main_of(options);
  });
  return cli::run_program(app, argc, argv, exit_code);
}

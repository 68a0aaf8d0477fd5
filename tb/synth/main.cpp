// SPDX-License-Identifier: Apache-2.0
// halfway_synth: every design of the list through Yosys for two FPGA families and through nextpnr for an
// iCE40 HX8K, into one table, and its figures against those pinned in tb/synth/pinned.txt.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "cli/program.hpp"
#include "common/file.hpp"
#include "common/subprocess.hpp"
#include "common/threads.hpp"
#include "designs.hpp"
#include "sim/synth/pinned.hpp"
#include "sim/synth/synthesis.hpp"

namespace halfway::synth {
namespace {

constexpr int kSkipped = 77;                         // as CMakeLists.txt has it in SKIP_RETURN_CODE
constexpr std::string_view kTable = "## Figures\n";  // of the page: what stands behind it is written anew
constexpr std::string_view kHead =
    "| design | LUTs | carries | flip-flops | RAMs | clock, MHz | seeds, MHz | ns a pixel | critical path | "
    "ECP5: LUTs | "
    "flip-flops | RAMs | multipliers |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | "
    "--- | --- |\n";

constexpr const char* kEndless = "nextpnr's router does not end";

struct Options {
  bool quick = false, cells = false, pin = false;
  unsigned seeds = 5, jobs = 2;
  std::filesystem::path page{};
  SimulatorFolders folders{};
  std::string part{};
};

// What a design came to.
struct Figures {
  std::optional<Ice40Cells> ice40{};
  std::optional<Ecp5Cells> ecp5{};
  std::string netlist{};
  std::vector<Placement> placements{};  ///< slowest first, once all are there
  const Placement* median() const {
    return placements.empty() ? nullptr : &placements[placements.size() / 2];
  }
  bool fits() const { return !placements.empty() && placements.front().fits(); }
  double mhz() const { return fits() ? median()->mhz : 0; }
};

std::string machine() {
  std::string name = "unknown processor", system = "unknown system";
  if (const auto text = read_file("/proc/cpuinfo")) {
    const std::size_t at = text->find("model name");
    if (at != std::string::npos) {
      const std::size_t colon = text->find(": ", at);
      name = text->substr(colon + 2, text->find('\n', colon) - colon - 2);
    }
  }
  if (const auto text = read_file("/etc/os-release")) {
    constexpr std::string_view c_key = "PRETTY_NAME=\"";
    const std::size_t at = text->find(c_key);
    if (at != std::string::npos)
      system = text->substr(at + c_key.size(), text->find('"', at + c_key.size()) - at - c_key.size());
  }
  return fmt::format("{}, {} threads, {}", name, std::thread::hardware_concurrency(), system);
}

std::string path_text(const CriticalPath& path) {
  return fmt::format("`{}` → `{}`: {} LUTs, {} carries, {:.1f} ns in cells, {:.1f} ns in wires", path.from,
                     path.to, path.luts, path.carries, path.logic, path.routing);
}

std::string row_begin(const std::string& name) {
  return fmt::format("| `{}` |", name);
}

std::string not_placed(const ListedDesign& listed, const Figures& f) {
  if (!listed.without.empty()) return "not placed: " + listed.without;
  if (!f.placements.empty()) return "does not fit the HX8K's 7680 cells";
  return listed.placed ? fmt::format("not placed: {}", kEndless) : "not placed";
}

std::string row(const ListedDesign& listed, const Figures& f) {
  std::string text = row_begin(listed.design.name);
  if (f.ice40)
    text += fmt::format(" {} | {} | {} | {} |", f.ice40->luts, f.ice40->carries, f.ice40->flip_flops,
                        f.ice40->rams);
  else
    text += " – | – | – | – |";
  if (f.fits())
    text += fmt::format(" {:.0f} | {:.0f} to {:.0f} of {} | {:.1f} | {} |", f.mhz(), f.placements.front().mhz,
                        f.placements.back().mhz, f.placements.size(), 1000 / f.mhz(),
                        path_text(f.median()->path));
  else
    text += fmt::format(" – | – | – | {} |", not_placed(listed, f));
  if (f.ecp5)
    text += fmt::format(" {} | {} | {} | {} |\n", f.ecp5->luts, f.ecp5->flip_flops, f.ecp5->rams,
                        f.ecp5->multipliers);
  else
    text += " – | – | – | – |\n";
  return text;
}

// The rows of designs measured before stay, those of designs that are no more go.
Status write_page(const std::filesystem::path& path, const std::map<std::string, std::string>& rows,
                  const std::string& versions) {
  auto text = read_file(path);
  if (!text) return text.error();
  const std::size_t figures = std::min(text->find(kTable), text->size());
  std::string table(kHead);
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
  return write_file(path,
                    fmt::format("{}{}\nBy {}, on {}.\n\n{}", *text, kTable, versions, machine(), table));
}

class Run {
 public:
  Run(const Options& options, const Synthesizer& synthesizer, std::vector<ListedDesign> designs)
      : options_(options),
        synthesizer_(synthesizer),
        designs_(std::move(designs)),
        figures_(designs_.size()) {}

  ExitCode run() {
    // Cells first: placements of one design need them, and so wait for each other less.
    std::vector<Job> jobs;
    for (std::size_t i = 0; i < designs_.size(); ++i) {
      jobs.push_back({i, Job::Kind::ice40});
      if (!options_.quick) jobs.push_back({i, Job::Kind::ecp5});
    }
    work(jobs);
    jobs.clear();
    if (!options_.cells)
      for (std::size_t i = 0; i < designs_.size(); ++i)
        for (unsigned seed = 1; designs_[i].placed && figures_[i].ice40 && seed <= options_.seeds; ++seed)
          jobs.push_back({i, Job::Kind::place, seed});
    work(jobs);
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

  void work(const std::vector<Job>& jobs) {
    std::atomic<std::size_t> next = 0;
    std::size_t done = 0;
    work_on_threads(options_.jobs, [&] {
      for (std::size_t at; (at = next++) < jobs.size();) {
        const Job& job = jobs[at];
        const auto said = work(job);
        const std::lock_guard lock(mutex_);
        broken_ += said ? 0 : 1;
        fmt::print("[{}/{}] {}: {}\n", ++done, jobs.size(), designs_[job.design].design.name,
                   said ? *said : said.error().message);
        std::fflush(stdout);
      }
    });
  }

  Result<std::string> work(const Job& job) {
    const Design& design = designs_[job.design].design;
    Figures& f = figures_[job.design];
    if (job.kind == Job::Kind::ice40) {
      const auto cells = synthesizer_.ice40(design);
      if (!cells) return cells.error();
      const auto netlist = synthesizer_.netlist_hash(design);
      if (!netlist) return netlist.error();
      const std::lock_guard lock(mutex_);
      f.ice40 = *cells;
      f.netlist = *netlist;
      return fmt::format("iCE40: {} LUTs, {} flip-flops", cells->luts, cells->flip_flops);
    }
    if (job.kind == Job::Kind::ecp5) {
      const auto cells = synthesizer_.ecp5(design);
      if (!cells) return cells.error();
      const std::lock_guard lock(mutex_);
      f.ecp5 = *cells;
      return fmt::format("ECP5: {} LUTs, {} flip-flops", cells->luts, cells->flip_flops);
    }
    const auto placement = synthesizer_.place(design, job.seed);
    if (!placement) return placement.error();
    if (!placement->ended) return fmt::format("seed {}: {}", job.seed, kEndless);
    const std::lock_guard lock(mutex_);
    f.placements.push_back(*placement);
    if (!placement->fits()) return std::string("does not fit the HX8K");
    return fmt::format("seed {}: {:.1f} MHz; {}", job.seed, placement->mhz, path_text(placement->path));
  }

  ExitCode report() {
    std::map<std::string, std::string> rows;
    fmt::print("\n{}", kHead);
    for (std::size_t i = 0; i < designs_.size(); ++i) {
      rows[designs_[i].design.name] = row(designs_[i], figures_[i]);
      fmt::print("{}", rows[designs_[i].design.name]);
    }
    fmt::print("\n");
    if (broken_ > 0) {
      fmt::print("{} figures could not be had\n", broken_);
      return ExitCode::tool_failed;
    }
    const auto path = options_.folders.source / kPins;
    Pins pins;
    // A part is pinned beside what is there.
    if (!options_.pin || (!options_.part.empty() && std::filesystem::exists(path))) {
      auto read = read_pins(path);
      if (!read) return failed(read.error());
      pins = std::move(*read);
    }
    int wrong = 0;
    for (std::size_t i = 0; i < designs_.size(); ++i) {
      const Figures& f = figures_[i];
      if (options_.pin) {
        Pin& pin = pins[designs_[i].design.name];
        pin.cells = *f.ice40;
        if (f.fits()) pin.mhz = f.mhz();  // else as it was
        if (f.fits() || pin.mhz == 0) pin.netlist = f.netlist;
      } else if (const std::string text = compare(designs_[i].design.name, pins, *f.ice40, f.mhz());
                 !text.empty()) {
        fmt::print("{}", text);
        ++wrong;
      }
    }
    if (options_.pin)
      if (const Status written = write_pins(path, pins, synthesizer_.versions()); !written)
        return failed(written.error());
    fmt::print("{} of {} designs are not as pinned\n", wrong, designs_.size());
    if (!options_.page.empty())
      if (const Status written = write_page(options_.page, rows, synthesizer_.versions()); !written)
        return failed(written.error());
    return wrong == 0 ? ExitCode::equal : ExitCode::differs;
  }

  static ExitCode failed(const Error& error) {
    fmt::print(stderr, "{}\n", error.message);
    return error.code;
  }

  const Options& options_;
  const Synthesizer& synthesizer_;
  std::vector<ListedDesign> designs_;
  std::vector<Figures> figures_;
  std::mutex mutex_;
  int broken_ = 0;
};

int main_of(const Options& options) {
  std::vector<ListedDesign> designs;
  for (ListedDesign& listed : all_designs())
    if ((listed.quick || !options.quick) && listed.design.name.find(options.part) != std::string::npos)
      designs.push_back(std::move(listed));
  if (designs.empty()) {
    fmt::print(stderr, "{}: no design has this in its name\n", options.part);
    return static_cast<int>(ExitCode::bad_input);
  }
  const auto synthesizer = Synthesizer::open(options.folders, !options.cells, {kAccumulator});
  if (!synthesizer) {
    const bool missing =
        find_program("yosys").empty() || (!options.cells && find_program("nextpnr-ice40").empty());
    const bool skipped = options.quick && missing;
    fmt::print(stderr, "{}{}\n", skipped ? "skipped: " : "", synthesizer.error().message);
    return skipped ? kSkipped : static_cast<int>(synthesizer.error().code);
  }
  return static_cast<int>(Run(options, *synthesizer, std::move(designs)).run());
}

}  // namespace
}  // namespace halfway::synth

int main(int argc, char** argv) {
  using namespace halfway;
  synth::Options options;
  CLI::App app{"Cells on two FPGA families and the clock on an iCE40 HX8K, against what is pinned",
               "halfway_synth"};
  auto* quick = app.add_flag(
      "--quick", options.quick,
      fmt::format("small designs, without ECP5; exit code {} where a tool is missing", synth::kSkipped));
  auto* cells = app.add_flag("--cells", options.cells, "no place and route");
  app.add_flag("--pin", options.pin, "write the figures into the pinned file in place of comparing")
      ->excludes(quick)
      ->excludes(cells);
  app.add_option("--seeds", options.seeds, "of placement")->check(CLI::Range(1, 999))->capture_default_str();
  app.add_option("--jobs", options.jobs, "at a time")->check(CLI::Range(1, 999))->capture_default_str();
  // Rows would have holes.
  app.add_option("--page", options.page, "file whose table is written anew")
      ->excludes(quick)
      ->excludes(cells);
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

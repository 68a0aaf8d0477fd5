// SPDX-License-Identifier: Apache-2.0
// halfway_mutants [--quick] [--count N] [--seed N] [--jobs N] [--page FILE] SOURCE VECTORS SCRATCH [PART]:
// puts one small fault after the other into a copy of the RTL; the project's tests must find each. SOURCE is
// the project's root, VECTORS what halfway_vectors wrote; with PART only faults in files whose names hold it.
//   --quick   the listed faults and a few generated ones, each by its own entity's testbench, but for the
//             slowest ones
//   --count   so many generated faults, over all files
//   --seed    other ones
//   --page    writes the tables into that file, behind what stands there before them
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <condition_variable>
#include <cstdio>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "common/file.hpp"
#include "coverage.hpp"
#include "equivalence.hpp"
#include "judge.hpp"
#include "listed.hpp"
#include "survivors.hpp"
#include "vhdl_text.hpp"

namespace halfway::mutants {
namespace {

constexpr int c_least_of_file = 6;  // mutants, where it has so many places
constexpr double c_quick = 5.0;     // seconds that testbenches of other entities may take before a proof is tried

struct Options {
  bool quick = false, coverage = false;
  unsigned count = 400, seed = 1, jobs = std::max(1U, std::thread::hardware_concurrency());
  std::filesystem::path page{};
  Folders folders{};
  std::string part{};
};

bool read_number(const std::string& text, unsigned& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

bool read_options(const std::vector<std::string>& arguments, Options& options) {
  std::vector<std::string> places;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const bool more = i + 1 < arguments.size();
    if (arguments[i] == "--quick") {
      options.quick = true;
    } else if (arguments[i] == "--coverage") {
      options.coverage = true;
    } else if (arguments[i] == "--page" && more) {
      options.page = arguments[++i];
    } else if (arguments[i] == "--count" && more) {
      if (!read_number(arguments[++i], options.count)) return false;
    } else if (arguments[i] == "--seed" && more) {
      if (!read_number(arguments[++i], options.seed)) return false;
    } else if (arguments[i] == "--jobs" && more) {
      if (!read_number(arguments[++i], options.jobs) || options.jobs == 0) return false;
    } else if (arguments[i].starts_with("--")) {
      return false;
    } else {
      places.push_back(arguments[i]);
    }
  }
  if (places.size() != 3 && places.size() != 4) return false;
  options.folders = {std::filesystem::absolute(places[0]), std::filesystem::absolute(places[1]),
                     std::filesystem::absolute(places[2])};
  if (places.size() == 4) options.part = places[3];
  return true;
}

struct Mutant {
  std::string file;     ///< in rtl/
  std::string by;       ///< the operator's name, or "listed"
  std::size_t line;
  std::string from, to, in_line;
  std::string content;  ///< of the whole file
  std::string tested;   ///< the testbench that has to find a listed one; empty: any may
};

enum class End { stillborn, own, other, frame, netlist, equivalent, survived };
constexpr int c_ends = static_cast<int>(End::survived) + 1;

struct Outcome {
  End end = End::survived;
  bool by_time = false;
  std::string by;  ///< the test that found it
};

std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (c != '\n' && c != ' ') line.push_back(c);
    else if (!line.empty() && line.back() != ' ') line.push_back(' ');
  }
  return line;
}

std::string name_of(const Mutant& m) {
  return fmt::format("rtl/{}:{}: {}: `{}` for `{}`", m.file, m.line, m.by, one_line(m.to), one_line(m.from));
}

Mutant mutant_of(const std::string& file, const std::string& content, std::string by, std::size_t begin,
                 std::size_t end, std::string to) {
  Mutant m{.file = file, .by = std::move(by), .line = line_of(content, begin), .from = content.substr(begin, end - begin),
           .to = std::move(to), .in_line = {}, .content = content, .tested = {}};
  const std::size_t from = content.rfind('\n', begin) + 1;
  m.in_line = one_line(content.substr(from, content.find('\n', begin) - from));
  while (m.in_line.starts_with(' ')) m.in_line.erase(0, 1);
  m.content.replace(begin, end - begin, m.to);
  return m;
}

// splitmix64
std::uint64_t next_random(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

// What a file can be changed into, in the order in which it is tried: the operators in turn, places at random.
struct Candidates {
  std::string file, content;
  std::vector<Change> order;
  std::size_t places = 0;  ///< a table's entries count as one
  std::size_t wanted = 0, taken = 0, found = 0, under_way = 0;
};

Result<Candidates> candidates_of(const VhdlSource& source, unsigned seed) {
  const auto outline = outline_of(source.name, source.content);
  if (!outline) return outline.error();
  Candidates all{.file = source.name.substr(4), .content = source.content, .order = {}};
  std::vector<std::deque<Change>> by_operator(c_operators);
  for (const Change& change : outline->changes) by_operator[static_cast<std::size_t>(change.by)].push_back(change);
  std::uint64_t state = seed;
  for (const char c : all.file) state = state * 31 + static_cast<unsigned char>(c);
  bool table = false;
  for (auto& changes : by_operator) {
    for (std::size_t i = changes.size(); i > 1; --i) std::swap(changes[i - 1], changes[next_random(state) % i]);
    if (!changes.empty() && changes.front().by == Operator::rom) {
      table = true;
    } else {
      all.places += changes.size();
    }
  }
  // The numbers of formats_pkg are widths and places in vectors.
  if (table || all.places > 1200) all.places = 60;
  while (true) {
    bool any = false;
    for (auto& changes : by_operator) {
      if (changes.empty()) continue;
      any = true;
      all.order.push_back(changes.front());
      changes.pop_front();
    }
    if (!any) return all;
  }
}

void share_out(std::vector<Candidates>& files, unsigned count) {
  std::size_t places = 0;
  for (const Candidates& file : files) places += file.places;
  for (Candidates& file : files) {
    const std::size_t share = (count * file.places + places / 2) / std::max<std::size_t>(places, 1);
    file.wanted = std::min(file.order.size(), std::max<std::size_t>(share, c_least_of_file));
  }
}

Result<std::vector<Mutant>> listed(const Judge& judge) {
  std::vector<Mutant> all;
  for (const Listed& fault : listed_mutants()) {
    const auto source = std::find_if(judge.rtl().begin(), judge.rtl().end(), [&](const VhdlSource& s) {
      return s.name == std::string("rtl/") + fault.file;
    });
    const std::size_t at = source == judge.rtl().end() ? std::string::npos : source->content.find(fault.from);
    if (at == std::string::npos || source->content.find(fault.from, at + 1) != std::string::npos)
      return bad_input(
          fmt::format("rtl/{}: `{}` does not occur once; mend the list of mutants", fault.file, fault.from));
    all.push_back(mutant_of(fault.file, source->content, "listed", at, at + fault.from.size(), std::string(fault.to)));
    all.back().tested = std::filesystem::path(fault.tested).stem();
  }
  return all;
}

// The testbenches that see the file: its own first, then those of the entities that use it, the quickest first.
std::vector<const Test*> testbenches_of(const Judge& judge, const Mutant& mutant) {
  std::vector<const Test*> tests;
  for (const Test& test : judge.testbenches())
    if (test.uses.contains(mutant.file)) tests.push_back(&test);
  const std::string own = std::filesystem::path(mutant.file).stem();
  std::stable_sort(tests.begin(), tests.end(), [&](const Test* a, const Test* b) {
    if ((a->name == own) != (b->name == own)) return a->name == own;
    return a->seconds < b->seconds;
  });
  return tests;
}

Result<Outcome> judged(const Judge& judge, Equivalence& equivalence, const Mutant& mutant) {
  auto bench = judge.bench({mutant.file, mutant.content});
  const std::string own = std::filesystem::path(mutant.file).stem();
  const auto try_one = [&](const Test& test, End end) -> Result<std::optional<Outcome>> {
    const auto verdict = bench.run(test);
    if (!verdict) return verdict.error();
    if (*verdict == Verdict::survived) return std::optional<Outcome>();
    if (*verdict == Verdict::stillborn) return std::optional(Outcome{End::stillborn, false, test.name});
    return std::optional(Outcome{end, *verdict == Verdict::killed_by_time, test.name});
  };
  const auto unit_tests = testbenches_of(judge, mutant);
  std::size_t i = 0;
  double seconds = 0;
  for (; i < unit_tests.size(); ++i) {
    if (!mutant.tested.empty() && unit_tests[i]->name != mutant.tested) continue;
    if (unit_tests[i]->name != own) seconds += unit_tests[i]->seconds;
    if (seconds > c_quick && mutant.tested.empty()) break;
    const auto ended = try_one(*unit_tests[i], unit_tests[i]->name == own || !mutant.tested.empty() ? End::own : End::other);
    if (!ended) return ended.error();
    if (*ended) return **ended;
  }
  // What its own testbench has to find is found by that one, or counts as not found.
  if (!mutant.tested.empty()) return Outcome{};
  const auto proved = equivalence.proved({mutant.file, mutant.content});
  if (!proved) return proved.error();
  if (*proved) return Outcome{End::equivalent, false, ""};
  for (; i < unit_tests.size(); ++i) {
    const auto ended = try_one(*unit_tests[i], End::other);
    if (!ended) return ended.error();
    if (*ended) return **ended;
  }
  std::vector<const Test*> frames;
  for (const Test& frame : judge.frames())
    if (frame.uses.contains(mutant.file)) frames.push_back(&frame);
  std::stable_sort(frames.begin(), frames.end(), [](const Test* a, const Test* b) { return a->seconds < b->seconds; });
  for (const Test* frame : frames) {
    const auto ended = try_one(*frame, End::frame);
    if (!ended) return ended.error();
    if (*ended) return **ended;
  }
  // GHDL passes over what hardware alone has. One frame of each shader is enough for that.
  std::set<Shader> seen;
  for (auto frame = frames.rbegin(); frame != frames.rend(); ++frame) {
    if (!seen.insert((*frame)->key.shader).second) continue;
    const auto verdict = judge.run_verilated(**frame, {mutant.file, mutant.content});
    if (!verdict) return verdict.error();
    if (*verdict != Verdict::survived) return Outcome{End::netlist, false, (*frame)->name};
  }
  return Outcome{};
}

struct Judged {
  Mutant mutant;
  Outcome outcome;
};

class Run {
 public:
  Run(const Judge& judge, const Options& options) : judge_(judge), equivalence_(judge), options_(options) {}

  Status all() {
    if (auto ready = gather(); !ready) return ready;
    std::vector<std::jthread> workers;
    for (unsigned i = 0; i < options_.jobs; ++i) workers.emplace_back([this] { work(); });
    workers.clear();
    return failed_;
  }
  std::vector<Judged>& judged_mutants() { return done_; }
  const std::map<std::string, int>& stillborn() const { return stillborn_; }

 private:
  Status gather() {
    auto from_list = listed(judge_);
    if (!from_list) return from_list.error();
    for (Mutant& mutant : *from_list)
      if (mutant.file.find(options_.part) != std::string::npos) listed_.push_back(std::move(mutant));
    for (const VhdlSource& source : judge_.rtl()) {
      auto file = candidates_of(source, options_.seed);
      if (!file) return file.error();
      files_.push_back(std::move(*file));
    }
    share_out(files_, options_.count);
    std::erase_if(files_, [&](const Candidates& file) { return file.file.find(options_.part) == std::string::npos; });
    if (files_.empty()) return bad_input(fmt::format("{}: no file of the RTL has this in its name", options_.part));
    for (const Candidates& file : files_) wanted_ += file.wanted;
    wanted_ += listed_.size();
    return Ok{};
  }

  // The next one, or none while enough are under way; `over` once no more can come.
  std::optional<Mutant> take(bool& over) {
    if (next_listed_ < listed_.size()) return listed_[next_listed_++];
    over = true;
    for (std::size_t k = 0; k < files_.size(); ++k) {
      Candidates& file = files_[(turn_ + k) % files_.size()];
      if (file.under_way > 0) over = false;
      if (file.found + file.under_way >= file.wanted || file.taken == file.order.size()) continue;
      turn_ = (turn_ + k + 1) % files_.size();
      ++file.under_way;
      const Change& change = file.order[file.taken++];
      over = false;
      return mutant_of(file.file, file.content, to_string(change.by), change.begin, change.end, change.to);
    }
    return std::nullopt;
  }

  void work() {
    std::unique_lock lock(mutex_);
    while (failed_) {
      bool over = false;
      auto mutant = take(over);
      if (!mutant) {
        if (over) return;
        changed_.wait(lock);
        continue;
      }
      lock.unlock();
      const auto outcome = judged(judge_, equivalence_, *mutant);
      lock.lock();
      settle(std::move(*mutant), outcome);
      changed_.notify_all();
    }
    changed_.notify_all();
  }

  void settle(Mutant mutant, const Result<Outcome>& outcome) {
    const auto file = std::find_if(files_.begin(), files_.end(), [&](const Candidates& f) { return f.file == mutant.file; });
    const bool generated = mutant.tested.empty();
    if (generated) --file->under_way;
    if (!outcome) {
      failed_ = Error{outcome.error().code, fmt::format("{}: {}", name_of(mutant), outcome.error().message)};
      return;
    }
    if (outcome->end == End::stillborn) {
      if (!generated)
        failed_ = bad_input(fmt::format("{}: GHDL refuses it; mend the list of mutants", name_of(mutant)));
      ++stillborn_[mutant.file];
      return;
    }
    if (generated) ++file->found;
    static constexpr const char* c_names[c_ends] = {"",
                                                    "killed by its testbench",
                                                    "killed by",
                                                    "killed by the frame",
                                                    "killed by Verilator's frame",
                                                    "equivalent, proved",
                                                    "SURVIVED"};
    const bool own = outcome->by == std::filesystem::path(mutant.file).stem().string();
    fmt::print("[{}/{}] {}: {}{}{}\n", done_.size() + 1, wanted_, name_of(mutant), c_names[static_cast<int>(outcome->end)],
               own || outcome->by.empty() ? "" : " " + outcome->by, outcome->by_time ? ", by its time" : "");
    std::fflush(stdout);
    done_.push_back({std::move(mutant), *outcome});
  }

  const Judge& judge_;
  Equivalence equivalence_;
  const Options& options_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Mutant> listed_;
  std::vector<Candidates> files_;
  std::size_t next_listed_ = 0, turn_ = 0, wanted_ = 0;
  std::vector<Judged> done_;
  std::map<std::string, int> stillborn_;
  Status failed_ = Ok{};
};

}  // namespace
}  // namespace halfway::mutants

int main(int argc, char** argv) {
  using namespace halfway;
  using namespace halfway::mutants;
  Options options;
  if (!read_options(std::vector<std::string>(argv + 1, argv + argc), options)) {
    fmt::print(stderr,
               "usage: halfway_mutants [--quick] [--count N] [--seed N] [--jobs N] [--page FILE] SOURCE VECTORS SCRATCH "
               "[PART]\n");
    return static_cast<int>(ExitCode::bad_input);
  }
  const auto judge = Judge::open(options.folders, options.jobs, !options.quick,
                                 [](const std::string& what) { fmt::print("{}\n", what); std::fflush(stdout); });
  if (!judge) {
    fmt::print(stderr, "{}\n", judge.error().message);
    return static_cast<int>(judge.error().code);
  }
  if (options.coverage) {
    const auto files = measure_coverage(*judge, options.jobs, [](const std::string& what) { fmt::print("{}\n", what); std::fflush(stdout); });
    if (!files) { fmt::print("{}\n", files.error().message); return 3; }
    for (const FileCoverage& f : *files) {
      fmt::print("{} lines {}/{} outcomes {}/{} bits {}/{}\n", f.file, f.lines_run, f.lines, f.outcomes_seen, f.outcomes, f.bits_toggled, f.bits);
      for (const auto& m : f.missed_lines) fmt::print("   L {}: {}\n", m.line, m.text);
      for (const auto& m : f.missed_outcomes) fmt::print("   O {}: {}\n", m.line, m.text);
      for (const auto& m : f.missed_signals) fmt::print("   S {}: {}\n", m.line, m.text);
    }
    return 0;
  }
  Run run(*judge, options);
  if (const auto ended = run.all(); !ended) {
    fmt::print(stderr, "{}\n", ended.error().message);
    return static_cast<int>(ended.error().code);
  }
  std::map<End, int> count;
  for (const Judged& j : run.judged_mutants()) ++count[j.outcome.end];
  for (const auto& [end, n] : count) fmt::print("{} {}\n", static_cast<int>(end), n);
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
// halfway_mutants: puts one small fault after the other into a copy of the RTL, which the project's tests
// must find, and counts what of the RTL those tests reach.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <condition_variable>
#include <cstdio>
#include <deque>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "coverage.hpp"
#include "equivalence.hpp"
#include "judge.hpp"
#include "listed.hpp"
#include "sim/program/program.hpp"
#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"
#include "sim/system/threads.hpp"
#include "survivors.hpp"
#include "vhdl_text.hpp"

namespace halfway::mutants {
namespace {

constexpr unsigned c_count = 400, c_seed = 1;
constexpr double c_share = 0.98;   // of the mutants not proved equivalent, what has to be killed
constexpr int c_quick_passes = 3;  // generated mutants that may pass --quick, which proves nothing equivalent
constexpr int c_least_of_file = 6;  // mutants, where it has so many places
constexpr double c_quick = 8.0;     // seconds that tests other than its own may take before a proof is tried

struct Options {
  bool quick = false, coverage = true;
  unsigned count = c_count, seed = c_seed, jobs = std::max(1U, std::thread::hardware_concurrency());
  std::filesystem::path page{};
  Folders folders{};
  std::string part{};
};

struct Mutant {
  std::string file;  ///< in rtl/
  std::string by;    ///< the operator's name, or "listed"
  std::size_t line;
  std::string from, to, in_line;
  std::string content;  ///< of the whole file
  std::string tested;   ///< the testbench that has to find a listed one; empty: any may
  bool asked = false;   ///< a fault that is found: it must not be proved equivalent
};

enum class End { stillborn, own, other, frame, netlist, equivalent, survived };
constexpr int c_ends = static_cast<int>(End::survived) + 1;

struct Outcome {
  End end = End::survived;
  bool by_time = false;
  std::string by;               ///< the test that found it
  bool wrongly_proved = false;  ///< equivalent, and yet it was found
};

std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (c != '\n' && c != ' ')
      line.push_back(c);
    else if (!line.empty() && line.back() != ' ')
      line.push_back(' ');
  }
  return line;
}

std::string name_of(const Mutant& m) {
  return fmt::format("rtl/{}:{}: {}: `{}` for `{}`", m.file, m.line, m.by, one_line(m.to), one_line(m.from));
}

Mutant mutant_of(const std::string& file, const std::string& content, std::string by, std::size_t begin,
                 std::size_t end, std::string to) {
  Mutant m{.file = file,
           .by = std::move(by),
           .line = line_of(content, begin),
           .from = content.substr(begin, end - begin),
           .to = std::move(to),
           .in_line = {},
           .content = content,
           .tested = {}};
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

// What a file can be changed into, in the order in which it is tried: the operators in turn, places at
// random.
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
  for (const Change& change : outline->changes)
    by_operator[static_cast<std::size_t>(change.by)].push_back(change);
  std::uint64_t state = seed;
  for (const char c : all.file) state = state * 31 + static_cast<unsigned char>(c);
  bool table = false;
  for (auto& changes : by_operator) {
    for (std::size_t i = changes.size(); i > 1; --i)
      std::swap(changes[i - 1], changes[next_random(state) % i]);
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
    all.push_back(
        mutant_of(fault.file, source->content, "listed", at, at + fault.from.size(), std::string(fault.to)));
    all.back().tested = std::filesystem::path(fault.tested).stem();
  }
  return all;
}

// The tests that see the file: its own testbench first, then those of the entities that use it and the
// frames, the quickest first.
std::vector<const Test*> tests_of(const Judge& judge, const Mutant& mutant) {
  std::vector<const Test*> tests;
  for (const auto* kind : {&judge.testbenches(), &judge.frames()})
    for (const Test& test : *kind)
      if (test.uses.contains(mutant.file)) tests.push_back(&test);
  const std::string own = std::filesystem::path(mutant.file).stem();
  std::stable_sort(tests.begin(), tests.end(), [&](const Test* a, const Test* b) {
    if ((a->name == own) != (b->name == own)) return a->name == own;
    return a->seconds < b->seconds;
  });
  return tests;
}

// By the testbench that has to find it, and no other.
Result<Outcome> judged_by_its_own(const Judge& judge, const Mutant& mutant, const std::string& own) {
  const auto test = std::find_if(judge.testbenches().begin(), judge.testbenches().end(),
                                 [&](const Test& t) { return t.name == own; });
  if (test == judge.testbenches().end()) return bad_input(fmt::format("{}: there is no such testbench", own));
  const auto verdict = judge.bench({mutant.file, mutant.content}).run(*test);
  if (!verdict) return verdict.error();
  if (*verdict == Verdict::survived) return Outcome{};
  return Outcome{*verdict == Verdict::stillborn ? End::stillborn : End::own,
                 *verdict == Verdict::killed_by_time, own};
}

Result<Outcome> judged(const Judge& judge, Equivalence& equivalence, bool quick, const Mutant& mutant) {
  const std::string own = std::filesystem::path(mutant.file).stem();
  bool tried_to_prove = false;
  const auto prove = [&]() -> Result<bool> {
    if (std::exchange(tried_to_prove, true)) return false;
    return equivalence.proved({mutant.file, mutant.content});
  };
  if (!mutant.tested.empty()) {
    auto outcome = judged_by_its_own(judge, mutant, mutant.tested);
    if (!outcome || !mutant.asked || outcome->end != End::own) return outcome;
    const auto proved = prove();
    if (!proved) return proved.error();
    outcome->wrongly_proved = *proved;
    return outcome;
  }
  if (quick) return judged_by_its_own(judge, mutant, own);
  auto bench = judge.bench({mutant.file, mutant.content});
  double seconds = 0;
  const auto tests = tests_of(judge, mutant);
  for (const Test* test : tests) {
    if (test->name != own) seconds += test->seconds;
    if (seconds > c_quick) {
      const auto proved = prove();
      if (!proved) return proved.error();
      if (*proved) return Outcome{End::equivalent, false, ""};
    }
    const auto verdict = bench.run(*test);
    if (!verdict) return verdict.error();
    if (*verdict == Verdict::survived) continue;
    if (*verdict == Verdict::stillborn) return Outcome{End::stillborn, false, test->name};
    const End end = test->name == own ? End::own : test->golden.empty() ? End::other : End::frame;
    return Outcome{end, *verdict == Verdict::killed_by_time, test->name};
  }
  const auto proved = prove();
  if (!proved) return proved.error();
  if (*proved) return Outcome{End::equivalent, false, ""};
  // GHDL passes over what hardware alone has. One frame of each shader is enough for that.
  std::set<Shader> seen;
  for (auto test = tests.rbegin(); test != tests.rend(); ++test) {
    if ((*test)->golden.empty() || !seen.insert((*test)->key.shader).second) continue;
    const auto verdict = judge.run_verilated(**test, {mutant.file, mutant.content});
    if (!verdict) return verdict.error();
    if (*verdict != Verdict::survived) return Outcome{End::netlist, false, (*test)->name};
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
    work_on_threads(options_.jobs, [this] { work(); });
    return failed_;
  }
  std::vector<Judged>& judged_mutants() { return done_; }
  const std::map<std::string, int>& stillborn() const { return stillborn_; }

 private:
  Status gather() {
    auto from_list = listed(judge_);
    if (!from_list) return from_list.error();
    std::set<std::string> asked;
    for (Mutant& mutant : *from_list)
      if (mutant.file.find(options_.part) != std::string::npos &&
          !(options_.quick && is_slow(mutant.tested))) {
        // A package's testbench also asks what no hardware does.
        mutant.asked =
            !options_.quick && !mutant.file.ends_with("_pkg.vhd") && asked.insert(mutant.file).second;
        listed_.push_back(std::move(mutant));
      }
    for (const VhdlSource& source : judge_.rtl()) {
      auto file = candidates_of(source, options_.seed);
      if (!file) return file.error();
      files_.push_back(std::move(*file));
    }
    share_out(files_, options_.count);
    std::erase_if(files_,
                  [&](const Candidates& file) { return file.file.find(options_.part) == std::string::npos; });
    if (options_.quick) {
      std::erase_if(files_, [&](const Candidates& file) {
        const std::string own = std::filesystem::path(file.file).stem();
        return is_slow(own) || std::none_of(judge_.testbenches().begin(), judge_.testbenches().end(),
                                            [&](const Test& test) { return test.name == own; });
      });
      for (Candidates& file : files_) file.wanted = 1;
    }
    if (files_.empty())
      return bad_input(fmt::format("{}: no file of the RTL has this in its name", options_.part));
    for (const Candidates& file : files_) wanted_ += file.wanted;
    wanted_ += listed_.size();
    return Ok{};
  }

  // Testbenches of minutes.
  static bool is_slow(std::string_view testbench) {
    return testbench == "processors_shader" || testbench == "spherical_shader";
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
      const auto outcome = judged(judge_, equivalence_, options_.quick, *mutant);
      lock.lock();
      settle(std::move(*mutant), outcome);
      changed_.notify_all();
    }
    changed_.notify_all();
  }

  void settle(Mutant mutant, const Result<Outcome>& outcome) {
    const auto file = std::find_if(files_.begin(), files_.end(),
                                   [&](const Candidates& f) { return f.file == mutant.file; });
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
    fmt::print("[{}/{}] {}: {}{}{}\n", done_.size() + 1, wanted_, name_of(mutant),
               c_names[static_cast<int>(outcome->end)], own || outcome->by.empty() ? "" : " " + outcome->by,
               outcome->by_time ? ", by its time" : "");
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

// One row of the table of entities.
struct Row {
  std::size_t mutants = 0;
  std::array<std::size_t, c_ends> ends{};
  std::size_t by_time = 0;
};

std::string row_text(std::string_view name, const Row& row) {
  const auto n = [&](End end) { return row.ends[static_cast<std::size_t>(end)]; };
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", name, row.mutants, n(End::own), n(End::other),
                     n(End::frame) + n(End::netlist), n(End::equivalent), n(End::survived));
}

void add(Row& row, const Outcome& outcome) {
  ++row.mutants;
  ++row.ends[static_cast<std::size_t>(outcome.end)];
  row.by_time += outcome.by_time ? 1 : 0;
}

std::string in_code(std::string_view text) {
  std::string code = one_line(text);
  for (std::size_t at = 0; (at = code.find('|', at)) != std::string::npos; at += 2) code.insert(at, "\\");
  return "`" + (code.empty() ? " " : code) + "`";
}

double percent(std::size_t part, std::size_t whole) {
  return whole == 0 ? 100.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

std::string share(std::size_t part, std::size_t whole) {
  return whole == 0 ? "–" : fmt::format("{} of {}", part, whole);
}

// What a run came to; its text is the page's second half.
struct Report {
  std::string text;
  std::vector<std::string> faults;  ///< why the run is no success
};

constexpr std::string_view kTable =
    "| entity | mutants | killed by its testbench | by another | by a frame | equivalent | survived |\n"
    "| --- | --- | --- | --- | --- | --- | --- |\n";

Report report_of(const Options& options, const Judge& judge, std::vector<Judged> all) {
  Report report;
  std::map<std::string, std::size_t> order;
  for (std::size_t i = 0; i < judge.rtl().size(); ++i) order[judge.rtl()[i].name.substr(4)] = i;
  std::stable_sort(all.begin(), all.end(), [&](const Judged& a, const Judged& b) {
    const auto key = [&](const Judged& j) {
      return std::tuple(order[j.mutant.file], j.mutant.line, j.mutant.by, j.mutant.from, j.mutant.to);
    };
    return key(a) < key(b);
  });
  std::map<std::size_t, Row> files;
  std::map<std::string, Row> operators;
  Row total, from_list;
  for (const Judged& j : all) {
    if (j.mutant.by == "listed") {
      add(from_list, j.outcome);
    } else {
      add(files[order[j.mutant.file]], j.outcome);
      add(operators[j.mutant.by], j.outcome);
      add(total, j.outcome);
    }
  }
  report.text += kTable;
  for (const auto& [file, row] : files)
    report.text += row_text("`" + judge.rtl()[file].name.substr(4) + "`", row);
  report.text += row_text("**all generated**", total);
  if (from_list.mutants > 0) report.text += row_text("listed", from_list);

  const std::size_t equivalent = total.ends[static_cast<std::size_t>(End::equivalent)];
  const std::size_t survived = total.ends[static_cast<std::size_t>(End::survived)];
  const std::size_t counted = total.mutants - equivalent, killed = counted - survived;
  report.text += fmt::format(
      "\nOf {} generated mutants {} are proved equivalent; of the {} others {} were killed: {:.1f} %. {} of "
      "all were killed by their time.\n",
      total.mutants, equivalent, counted, killed, percent(killed, counted),
      total.by_time + from_list.by_time);
  if (static_cast<double>(killed) < c_share * static_cast<double>(counted))
    report.faults.push_back(fmt::format("{:.1f} % of the mutants were killed, {:.0f} % have to be",
                                        percent(killed, counted), 100.0 * c_share));

  if (from_list.mutants > 0 && !options.quick) {
    const auto asked = std::count_if(all.begin(), all.end(), [](const Judged& j) { return j.mutant.asked; });
    for (const Judged& j : all)
      if (j.outcome.wrongly_proved)
        report.faults.push_back(
            fmt::format("{}: proved equivalent, and found by {}; the proof looks at too little",
                        name_of(j.mutant), j.outcome.by));
    report.text += fmt::format(
        "The proof of equivalence was asked about {} of the listed faults, one a file, and proved none of "
        "them.\n",
        asked);
  }

  report.text +=
      "\n| operator | mutants | killed by its testbench | by another | by a frame | equivalent | survived |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n";
  for (int i = 0; i < c_operators; ++i)
    if (const auto row = operators.find(to_string(static_cast<Operator>(i))); row != operators.end())
      report.text += row_text(row->first, row->second);

  report.text += "\n## Survivors\n\n";
  std::size_t listed_survivors = 0;
  std::set<const KnownSurvivor*> met;
  std::string rows;
  for (const Judged& j : all) {
    if (j.outcome.end != End::survived) continue;
    if (j.mutant.by == "listed") {
      report.faults.push_back(fmt::format("{}: not found by {}", name_of(j.mutant), j.mutant.tested));
      continue;
    }
    ++listed_survivors;
    const auto known =
        std::find_if(known_survivors().begin(), known_survivors().end(), [&](const KnownSurvivor& k) {
          return k.file == j.mutant.file && k.in_line == j.mutant.in_line &&
                 k.from == one_line(j.mutant.from) && k.to == one_line(j.mutant.to);
        });
    if (known == known_survivors().end())
      report.faults.push_back(fmt::format("{}: survives, and survivors.cpp has no reason; in the line {}",
                                          name_of(j.mutant), j.mutant.in_line));
    else
      met.insert(&*known);
    rows += fmt::format("| `{}`, line {} | {} for {} in {} | {} |\n", j.mutant.file, j.mutant.line,
                        in_code(j.mutant.to), in_code(j.mutant.from), in_code(j.mutant.in_line),
                        known == known_survivors().end() ? "" : known->reason);
  }
  report.text += listed_survivors == 0
                     ? "None.\n"
                     : "| where | fault | why no test sees it |\n| --- | --- | --- |\n" + rows;
  if (options.part.empty() && options.count == c_count && options.seed == c_seed)
    for (const KnownSurvivor& known : known_survivors())
      if (!met.contains(&known))
        report.faults.push_back(
            fmt::format("survivors.cpp: {}: `{}` for `{}` survives no more, or is not made; take it off",
                        known.file, known.to, known.from));
  return report;
}

void add_coverage(Report& report, const std::vector<FileCoverage>& files) {
  report.text += "\n## Coverage\n\n| entity | lines | outcomes | bits |\n| --- | --- | --- | --- |\n";
  FileCoverage all;
  std::string rows;
  std::set<const KnownGap*> met;
  for (const FileCoverage& f : files) {
    report.text += fmt::format("| `{}` | {} | {} | {} |\n", f.file, share(f.lines_run, f.lines),
                               share(f.outcomes_seen, f.outcomes), share(f.bits_toggled, f.bits));
    all.lines += f.lines;
    all.lines_run += f.lines_run;
    all.outcomes += f.outcomes;
    all.outcomes_seen += f.outcomes_seen;
    all.bits += f.bits;
    all.bits_toggled += f.bits_toggled;
    for (const auto* missed : {&f.missed_lines, &f.missed_outcomes})
      for (const Missed& m : *missed) {
        const std::string text = one_line(m.text);
        const auto known = std::find_if(known_gaps().begin(), known_gaps().end(), [&](const KnownGap& gap) {
          return gap.file == f.file && gap.text == text;
        });
        if (known == known_gaps().end())
          report.faults.push_back(fmt::format(
              "rtl/{}:{}: {}: reached by no test, and survivors.cpp has no reason", f.file, m.line, text));
        else
          met.insert(&*known);
        rows += fmt::format("| `{}`, line {} | {} | {} |\n", f.file, m.line,
                            missed == &f.missed_lines ? in_code(text) : text,
                            known == known_gaps().end() ? "" : known->reason);
      }
  }
  for (const KnownGap& known : known_gaps())
    if (!met.contains(&known))
      report.faults.push_back(
          fmt::format("survivors.cpp: {}: `{}` is reached; take it off", known.file, known.text));
  report.text += fmt::format("| **all** | {}: {:.1f} % | {}: {:.1f} % | {}: {:.1f} % |\n",
                             share(all.lines_run, all.lines), percent(all.lines_run, all.lines),
                             share(all.outcomes_seen, all.outcomes), percent(all.outcomes_seen, all.outcomes),
                             share(all.bits_toggled, all.bits), percent(all.bits_toggled, all.bits));
  report.text += "\nLines and outcomes that no test reaches:\n\n";
  report.text += rows.empty() ? "None.\n" : "| where | what | why |\n| --- | --- | --- |\n" + rows;
}

Status write_page(const std::filesystem::path& path, const std::string& tables) {
  auto text = read_file(path);
  if (!text) return text.error();
  text->resize(std::min(text->find(kTable.substr(0, kTable.find('\n'))), text->size()));
  return write_file(path, *text + tables);
}

ExitCode fail(const Error& error) {
  fmt::print(stderr, "{}\n", error.message);
  return error.code;
}

ExitCode run_quick(const std::vector<Judged>& all) {
  int missed = 0, passed = 0;
  for (const Judged& j : all) {
    if (j.outcome.end != End::survived) continue;
    if (j.mutant.by == "listed")
      ++missed;
    else
      ++passed;
  }
  fmt::print(
      "{} of {} mutants not found: {} listed ones, of which none may pass, {} generated ones, of which {} "
      "may be "
      "equivalent\n",
      missed + passed, all.size(), missed, passed, c_quick_passes);
  return missed > 0 || passed > c_quick_passes ? ExitCode::differs : ExitCode::equal;
}

ExitCode run(const Options& options) {
  const auto told = [](const std::string& what) {
    fmt::print("{}\n", what);
    std::fflush(stdout);
  };
  if (!options.quick)
    for (const char* tool : {"yosys", "yosys-abc"})
      if (find_program(tool).empty())
        return fail(tool_failed(fmt::format("{}: is missing; install it with: apt-get install yosys", tool)));
  const auto judge = Judge::open(options.folders, options.jobs, !options.quick, told);
  if (!judge) return fail(judge.error());
  Run run(*judge, options);
  if (const auto ended = run.all(); !ended) return fail(ended.error());
  if (options.quick) return run_quick(run.judged_mutants());
  Report report = report_of(options, *judge, run.judged_mutants());
  if (options.coverage) {
    const auto files = measure_coverage(*judge, options.jobs, told);
    if (!files) return fail(files.error());
    add_coverage(report, *files);
  }
  fmt::print("\n{}\n", report.text);
  for (const std::string& fault : report.faults) fmt::print("{}\n", fault);
  if (!report.faults.empty()) return ExitCode::differs;
  if (options.page.empty()) return ExitCode::equal;
  const auto written = write_page(options.page, report.text);
  return written ? ExitCode::equal : fail(written.error());
}

}  // namespace
}  // namespace halfway::mutants

int main(int argc, char** argv) {
  using namespace halfway;
  mutants::Options options;
  CLI::App app{"Puts small faults into the RTL, which the tests must find, and counts what those tests reach",
               "halfway_mutants"};
  app.add_flag("--quick", options.quick,
               "the listed faults and a generated one for each file that has a testbench, each by that "
               "testbench; without the slowest");
  app.add_option("--count", options.count, "generated faults, over all files")->capture_default_str();
  app.add_option("--seed", options.seed, "other ones: those of the page are of seed 1")
      ->capture_default_str();
  app.add_option("--jobs", options.jobs, "at a time")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_flag("--no-coverage{false}", options.coverage, "mutants alone");
  app.add_option("--page", options.page, "file whose tables are written anew");
  app.add_option("SOURCE", options.folders.source, "the project's root")->required();
  app.add_option("VECTORS", options.folders.vectors, "what halfway_vectors wrote")->required();
  app.add_option("SCRATCH", options.folders.scratch, "folder for what is remembered of runs before")
      ->required();
  app.add_option("PART", options.part, "only faults in files whose names hold it");
  int exit_code = 0;
  app.callback([&] {
    for (auto* folder : {&options.folders.source, &options.folders.vectors, &options.folders.scratch})
      *folder = std::filesystem::absolute(*folder);
    exit_code = static_cast<int>(mutants::run(options));
  });
  return cli::run_program(app, argc, argv, exit_code);
}

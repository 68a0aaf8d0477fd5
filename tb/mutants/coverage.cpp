// SPDX-License-Identifier: Apache-2.0
#include "coverage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "sim/system/subprocess.hpp"
#include "vhdl_text.hpp"

namespace halfway::mutants {
namespace {

constexpr std::chrono::minutes c_time{15};
constexpr const char* kInstall = "apt-get install g++";

enum class Counts { statement, condition, signal };

// By its number in the VHDL.
struct Place {
  Counts counts;
  std::size_t file;  ///< in the RTL's order
  std::size_t line;
  std::string text;
  bool ran = false, was_true = false, was_false = false;
  std::string toggled{};  ///< '1' where a bit did, the lowest last
};

std::string line_text(std::string_view text, std::size_t at) {
  const std::size_t from = text.rfind('\n', at) + 1;
  std::string line(text.substr(from, text.find('\n', at) - from));
  line.erase(0, line.find_first_not_of(' '));
  return line;
}

// The RTL with counters in it.
Result<std::vector<VhdlSource>> instrumented(const std::vector<VhdlSource>& rtl, std::vector<Place>& places) {
  std::vector<VhdlSource> sources;
  for (std::size_t file = 0; file < rtl.size(); ++file) {
    const std::string& text = rtl[file].content;
    const auto outline = outline_of(rtl[file].name, text);
    if (!outline) return outline.error();
    struct Insertion {
      std::size_t at;
      std::string text;
    };
    std::vector<Insertion> insertions;
    const auto count = [&](Counts counts, std::size_t at, std::string what) {
      places.push_back({counts, file, line_of(text, at), std::move(what)});
      return places.size() - 1;
    };
    for (const Statement& s : outline->statements)
      insertions.push_back({s.at, fmt::format("assert work.coverage_pkg.ran({}); ",
                                              count(Counts::statement, s.at, line_text(text, s.at)))});
    for (const Condition& c : outline->conditions) {
      const std::size_t id = count(Counts::condition, c.begin, text.substr(c.begin, c.end - c.begin));
      insertions.push_back({c.begin, fmt::format("work.coverage_pkg.was({}, ", id)});
      insertions.push_back({c.end, ")"});
    }
    for (const Watched& w : outline->watched)
      insertions.push_back({w.at, fmt::format(" work.coverage_pkg.saw(coverage_instance, {}, {});",
                                              count(Counts::signal, w.at, w.name), w.name)});
    if (!outline->architecture_of.empty())
      insertions.push_back(
          {outline->declarations,
           fmt::format(" constant coverage_instance : natural := work.coverage_pkg.new_instance({});",
                       file)});
    std::stable_sort(insertions.begin(), insertions.end(),
                     [](const Insertion& a, const Insertion& b) { return a.at < b.at; });
    std::string result;
    std::size_t from = 0;
    for (const Insertion& insertion : insertions) {
      result.append(text, from, insertion.at - from);
      result += insertion.text;
      from = insertion.at;
    }
    result.append(text, from);
    sources.push_back({rtl[file].name, std::move(result)});
  }
  return sources;
}

Status add_counts(const std::string& written, std::vector<Place>& places) {
  bool whole = false;
  for (std::size_t begin = 0; begin < written.size();) {
    const std::size_t end = std::min(written.find('\n', begin), written.size());
    const std::string_view line = std::string_view(written).substr(begin, end - begin);
    begin = end + 1;
    whole = line == "end";
    if (whole) break;
    const std::size_t space = line.find(' ');
    std::size_t id = places.size();
    const auto parsed = std::from_chars(line.data() + space + 1, line.data() + line.size(), id);
    if (id >= places.size()) return tool_failed(fmt::format("coverage: `{}` names no place", line));
    Place& place = places[id];
    const std::string_view what = line.substr(0, space);
    if (what == "ran") place.ran = true;
    if (what == "true") place.was_true = true;
    if (what == "false") place.was_false = true;
    if (what == "saw") {
      const std::string_view bits(parsed.ptr + 1,
                                  static_cast<std::size_t>(line.data() + line.size() - parsed.ptr - 1));
      if (place.toggled.size() < bits.size())
        place.toggled.insert(0, bits.size() - place.toggled.size(), '0');
      for (std::size_t k = 1; k <= bits.size(); ++k)
        if (bits[bits.size() - k] == '1') place.toggled[place.toggled.size() - k] = '1';
    }
  }
  return whole ? Status(Ok{}) : tool_failed("coverage: a simulation left no whole count");
}

std::vector<FileCoverage> summed(const std::vector<VhdlSource>& rtl, const std::vector<Place>& places) {
  std::vector<FileCoverage> files;
  for (const VhdlSource& source : rtl) files.push_back({.file = source.name.substr(4)});
  std::map<std::pair<std::size_t, std::size_t>, std::pair<bool, std::string>> lines;
  for (const Place& place : places) {
    FileCoverage& file = files[place.file];
    if (place.counts == Counts::statement) {
      auto& line = lines.try_emplace({place.file, place.line}, true, place.text).first->second;
      line.first = line.first && place.ran;
    } else if (place.counts == Counts::condition) {
      file.outcomes += 2;
      for (const auto& [seen, what] :
           {std::pair{place.was_true, "true"}, std::pair{place.was_false, "false"}}) {
        if (seen)
          ++file.outcomes_seen;
        else
          file.missed_outcomes.push_back({place.line, fmt::format("`{}` never {}", place.text, what)});
      }
    } else {
      const std::size_t toggled =
          static_cast<std::size_t>(std::count(place.toggled.begin(), place.toggled.end(), '1'));
      file.bits += place.toggled.size();
      file.bits_toggled += toggled;
      if (toggled < place.toggled.size())
        file.missed_signals.push_back({place.line, fmt::format("`{}` {} of {}: {}", place.text, toggled,
                                                               place.toggled.size(), place.toggled)});
    }
  }
  for (const auto& [where, line] : lines) {
    ++files[where.first].lines;
    if (line.first)
      ++files[where.first].lines_run;
    else
      files[where.first].missed_lines.push_back({where.second, line.second});
  }
  return files;
}

}  // namespace

Result<std::vector<FileCoverage>> measure_coverage(const Judge& judge, unsigned workers,
                                                   const std::function<void(const std::string&)>& told) {
  const auto tool = GhdlTool::find();
  if (!tool) return tool.error();
  if (tool->back_end == GhdlBackEnd::mcode)
    return tool_failed(
        fmt::format("ghdl: coverage needs a back end that links; install it with: {}", kInstallGhdl));
  std::vector<Place> places;
  auto sources = instrumented(judge.rtl(), places);
  if (!sources) return sources.error();
  auto counters = read_vhdl_source(judge.folders().source, "tb/mutants/coverage_pkg.vhd");
  if (!counters) return counters.error();
  sources->insert(sources->begin(), std::move(*counters));
  sources->insert(sources->end(), judge.testbench_sources().begin(), judge.testbench_sources().end());

  auto folder = TemporaryFolder::make(judge.folders().scratch / "benches");
  if (!folder) return folder.error();
  const auto call = [&](std::vector<std::string> arguments, const char* install) -> Status {
    const auto end =
        run_process({.arguments = arguments, .working_folder = folder->path(), .timeout = c_time}, install);
    if (!end) return end.error();
    if (end->succeeded()) return Ok{};
    return tool_failed(fmt::format("coverage: {} failed ({}):\n{}", arguments[0], end->how(), end->output));
  };
  told("coverage: analysis");
  if (auto made =
          call({"cc", "-O2", "-c", (judge.folders().source / "tb/mutants/coverage_counters.c").string(), "-o",
                "counters.o"},
               kInstall);
      !made)
    return made.error();
  std::vector<std::string> analyse = {"ghdl", "-a", "--std=08"};
  for (const VhdlSource& source : *sources) {
    if (auto written = write_file(folder->path() / source.name, source.content); !written)
      return written.error();
    analyse.push_back(source.name);
  }
  if (auto made = call(std::move(analyse), kInstallGhdl); !made) return made.error();

  // Numbers of places change with every file.
  ContentHash numbers;
  for (const VhdlSource& source : *sources) numbers.add(source.content);
  const std::string numbered = numbers.hex();
  std::vector<const Test*> tests;
  for (const Test& test : judge.testbenches()) tests.push_back(&test);
  for (const Test& test : judge.frames()) tests.push_back(&test);
  // The longest first.
  std::stable_sort(tests.begin(), tests.end(),
                   [](const Test* a, const Test* b) { return a->seconds > b->seconds; });
  std::mutex mutex;
  Status failed = Ok{};
  in_parallel(workers, tests.size(), [&](std::size_t i) {
    const Test& test = *tests[i];
    const std::filesystem::path kept =
        judge.folders().scratch / "counted" / ContentHash().add(numbered).add(test.hash).hex();
    const auto run = [&]() -> Result<std::string> {
      if (auto before = read_file(kept)) return before;
      {
        const std::lock_guard lock(mutex);
        if (auto made = call({"ghdl", "-e", "--std=08", "-Wl,counters.o", test.top}, kInstallGhdl); !made)
          return made.error();
        told("coverage: " + test.name);
      }
      Command command{
          .arguments = {folder->path() / test.top}, .working_folder = folder->path(), .timeout = c_time};
      command.arguments.insert(command.arguments.end(), test.arguments.begin(), test.arguments.end());
      if (!test.golden.empty())
        command.arguments.push_back("-gg_trace_file=" + (folder->path() / (test.top + ".trace")).string());
      command.arguments.insert(command.arguments.end(), {"--ieee-asserts=disable", "--assert-level=error"});
      const std::filesystem::path counted = folder->path() / (test.top + ".counted");
      command.environment = {{"HALFWAY_COVERAGE", counted.string()}};
      const auto end = run_process(command, kInstallGhdl);
      if (!end) return end.error();
      if (!end->succeeded())
        return tool_failed(fmt::format("coverage: {} failed ({}):\n{}", test.name, end->how(), end->output));
      auto content = read_file(counted);
      if (!content) return content.error();
      if (auto written = write_file(kept, *content); !written) return written.error();
      return content;
    };
    const auto counted = run();
    const std::lock_guard lock(mutex);
    if (!counted) {
      failed = counted.error();
    } else if (auto added = add_counts(*counted, places); !added) {
      failed = added;
    }
  });
  if (!failed) return failed.error();
  return summed(judge.rtl(), places);
}

}  // namespace halfway::mutants

// SPDX-License-Identifier: Apache-2.0
// halfway_search: tries random inputs, or the kept ones. A failing input is shrunk, printed and written to a
// file.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "page/page.hpp"
#include "sim/pages/template.hpp"
#include "sim/program/program.hpp"
#include "sim/system/file.hpp"
#include "sim/system/seconds.hpp"
#include "stability/scene_search.hpp"
#include "stability/search.hpp"
#include "stability/shrink.hpp"
#include "stability/triangle_search.hpp"

namespace halfway::stability {

namespace {

std::vector<std::unique_ptr<Search>> all_searches() {
  std::vector<std::unique_ptr<Search>> searches;
  searches.push_back(make_triangle_search());
  searches.push_back(make_spherical_search());
  searches.push_back(make_processors_search());
  return searches;
}

// Number of inputs that a thread takes at a time and draws together in the RTL.
constexpr std::uint64_t c_batch = 100;

struct Options {
  bool quick = false;
  std::uint32_t seed = 1;
  std::map<std::string_view, std::uint64_t> counts{};  ///< by name of the search; empty: all searches
  std::filesystem::path page{}, keep{}, replay{}, source{};
  SimulatorFolders folders() const { return {source, source / "build" / "cache"}; }
};

// Different seeds of a run, and runs with neighbouring seeds, share no input.
std::uint32_t seed_of(std::uint32_t run, std::uint64_t index) {
  return run * 0x9E37'79B9U + static_cast<std::uint32_t>(index);
}

struct Found {
  std::uint64_t index;  ///< of the input, or of the first one of its batch
  bool in_rtl;
  Failure failure;
};

// State that all threads of one search share.
class Run {
 public:
  Run(const Search& search, const Options& options, std::uint64_t count)
      : search_(search), options_(options), count_(count) {}

  void work() {
    const auto checker = search_.checker(options_.folders(), options_.quick);
    Tally tally;
    std::vector<Input> batch;
    // Batches are taken in order, so that the first failure does not depend on the number of threads.
    for (std::uint64_t at; !stop_ && (at = next_.fetch_add(c_batch)) < count_;) {
      const std::uint64_t end = std::min(at + c_batch, count_);
      batch.clear();
      for (std::uint64_t i = at; i < end; ++i) {
        batch.push_back(search_.make(seed_of(options_.seed, i)));
        if (auto failure = checker->check(batch.back(), tally)) return found({i, false, *failure}, tally);
      }
      if (at / c_batch % search_.rtl_every() == 0) {
        const auto rtl = checker->check_rtl(batch, tally);
        if (!rtl) return broken(rtl.error(), tally);
        if (*rtl) return found({at, true, **rtl}, tally);
      }
      done_ += end - at;
    }
    const std::lock_guard lock(mutex_);
    tally_.add(tally);
  }

  std::uint64_t done() const { return done_; }
  const Tally& tally() const { return tally_; }
  const std::optional<Found>& failure() const { return found_; }
  const Status& tools() const { return tools_; }

 private:
  void found(Found failure, const Tally& tally) {
    const std::lock_guard lock(mutex_);
    tally_.add(tally);
    stop_ = true;
    if (!found_ || failure.index < found_->index) found_ = std::move(failure);
  }
  void broken(const Error& error, const Tally& tally) {
    const std::lock_guard lock(mutex_);
    tally_.add(tally);
    stop_ = true;
    tools_ = error;
  }

  const Search& search_;
  const Options& options_;
  std::uint64_t count_;
  std::atomic<std::uint64_t> next_ = 0, done_ = 0;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  Tally tally_;
  std::optional<Found> found_;
  Status tools_ = Ok{};
};

// Shrinks the failing input, prints it and writes it to a file.
Status report(const Search& search, const Options& options, const Found& found) {
  const auto checker = search.checker(options.folders(), options.quick);
  Tally ignored;
  const auto failure_of = [&](const Input& input) -> std::optional<Failure> {
    if (!found.in_rtl) return checker->check(input, ignored);
    const auto rtl = checker->check_rtl(std::span(&input, 1), ignored);
    return rtl ? *rtl : std::nullopt;
  };
  const auto fails = [&](const Input& input) {
    const auto failure = failure_of(input);
    return failure && failure->quantity == found.failure.quantity;
  };
  const std::uint64_t last = found.in_rtl ? found.index + c_batch : found.index + 1;
  for (std::uint64_t i = found.index; i < last; ++i) {
    Input input = search.make(seed_of(options.seed, i));
    if (!fails(input)) continue;
    input = shrink(search.parameters(), std::move(input), fails,
                   [&](const Input& from) { return search.simpler(from); });
    const Failure shrunk = *failure_of(input);
    const std::string text = write_regression(
        search.name(), search.parameters(), input,
        fmt::format("{}: {} (seed {}, input {})", shrunk.quantity, shrunk.what, options.seed, i));
    fmt::print("{}: input {} of seed {} FAILS: {}: {}\nthe reduced input:\n{}", search.name(), i,
               options.seed, found.failure.quantity, found.failure.what, text);
    if (options.keep.empty()) return Ok{};
    if (auto made = make_folders(options.keep); !made) return made;
    const auto file =
        options.keep / fmt::format("{}_{}_{}_{}.txt", search.name(), shrunk.quantity, options.seed, i);
    fmt::print("stored as {}\n", file.string());
    return write_file(file, text);
  }
  fmt::print("{}: inputs {} to {} of seed {} FAIL when drawn in sequence, but none of them alone: {}\n",
             search.name(), found.index, last - 1, options.seed, found.failure.what);
  return Ok{};
}

std::string section_body(const Search& search, const Options& options, const Tally& tally, double seconds,
                         double processor_seconds) {
  const std::vector<std::string> columns = {"quantity", "inputs", "worst", "of"};
  std::vector<std::vector<std::string>> rows;
  for (const auto& [quantity, worst] : tally.worst)
    rows.push_back({quantity, std::to_string(worst.count), fmt::format("{:.3g}", worst.figure),
                    fmt::format("{:.3g}", worst.bound)});
  return fmt::format(
      "{}\n\n`make search` with seed {}: {} inputs and {} fragments through the golden model against the "
      "specification, {} inputs and {} fragments through the RTL (Verilator) against the golden model; "
      "{:.0f} s, {:.0f} s of processor time.\n\n{}",
      search.about(), options.seed, tally.inputs, tally.fragments, tally.rtl_inputs, tally.rtl_fragments,
      seconds, processor_seconds, markdown_table(columns, rows));
}

ExitCode run_search(const Search& search, const Options& options, std::uint64_t count,
                    std::vector<page::Section>& sections) {
  const auto began = std::chrono::steady_clock::now();
  const std::clock_t processor_began = std::clock();
  const auto seconds = [&] { return seconds_since(began); };
  Run run(search, options, count);
  {
    // Must outlive the workers: each one decrements it at its end.
    std::atomic<unsigned> working = options.quick ? 1 : std::max(1U, std::thread::hardware_concurrency());
    std::vector<std::jthread> workers;
    for (unsigned i = working; i > 0; --i)
      workers.emplace_back([&] {
        run.work();
        --working;
      });
    while (isatty(STDERR_FILENO) && working > 0) {
      fmt::print(stderr, "{}: {} of {}, {:.0f} s\r", search.name(), run.done(), count, seconds());
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
  }
  const Tally& tally = run.tally();
  fmt::print("{}: {} inputs, {} fragments; {} inputs, {} fragments in the RTL; {:.1f} s\n", search.name(),
             tally.inputs, tally.fragments, tally.rtl_inputs, tally.rtl_fragments, seconds());
  for (const auto& [quantity, worst] : tally.worst)
    fmt::print("  {}: {:.4g} of {:.4g} at worst, {} inputs {}\n", quantity, worst.figure, worst.bound,
               worst.count, worst.where.empty() ? "" : "(" + worst.where + ")");
  if (run.failure()) {
    const auto reported = report(search, options, *run.failure());
    if (!reported) fmt::print(stderr, "{}\n", reported.error().message);
    return ExitCode::differs;
  }
  if (!run.tools()) {
    fmt::print(stderr, "{}\n", run.tools().error().message);
    return run.tools().error().code;
  }
  sections.push_back({fmt::format("Search: {}", search.name()),
                      section_body(search, options, tally, seconds(),
                                   double(std::clock() - processor_began) / CLOCKS_PER_SEC)});
  return ExitCode::equal;
}

ExitCode replay(const std::vector<std::unique_ptr<Search>>& searches, const Options& options) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(options.replay, error))
    if (entry.path().extension() == ".txt") files.push_back(entry.path());
  std::ranges::sort(files);
  std::size_t failed = 0;
  for (const auto& file : files) {
    const auto text = read_file(file);
    if (!text) {
      fmt::print(stderr, "{}\n", text.error().message);
      return text.error().code;
    }
    const auto search_of = [&](std::string_view name) {
      return std::ranges::find_if(searches, [&](const auto& search) { return search->name() == name; });
    };
    const auto regression = read_regression(file.string(), *text, [&](std::string_view name) {
      const auto search = search_of(name);
      return search == searches.end() ? std::span<const Parameter>() : (*search)->parameters();
    });
    if (!regression) {
      fmt::print(stderr, "{}\n", regression.error().message);
      return regression.error().code;
    }
    const auto checker = (*search_of(regression->search))->checker(options.folders(), false);
    Tally tally;
    auto failure = checker->check(regression->input, tally);
    if (!failure) {
      const auto rtl = checker->check_rtl(std::span(&regression->input, 1), tally);
      if (!rtl) {
        fmt::print(stderr, "{}\n", rtl.error().message);
        return rtl.error().code;
      }
      failure = *rtl;
    }
    failed += failure.has_value();
    fmt::print("{}: {}\n", file.filename().string(),
               failure ? fmt::format("FAILS: {}: {}", failure->quantity, failure->what) : "holds");
  }
  fmt::print("{} of {} regressions fail\n", failed, files.size());
  return failed > 0 ? ExitCode::differs : ExitCode::equal;
}

ExitCode run_all(const std::vector<std::unique_ptr<Search>>& searches, const Options& options) {
  std::vector<page::Section> sections;
  ExitCode worst = ExitCode::equal;
  for (const auto& search : searches) {
    std::uint64_t count = options.quick ? search->quick_count() : search->full_count();
    if (!options.counts.empty()) {
      const auto asked = options.counts.find(search->name());
      if (asked == options.counts.end()) continue;
      count = asked->second;
    }
    worst = std::max(worst, run_search(*search, options, count, sections));
  }
  if (options.page.empty()) return worst;
  const auto written = page::write_sections(options.page, sections);
  if (written) return worst;
  fmt::print(stderr, "{}\n", written.error().message);
  return written.error().code;
}

}  // namespace
}  // namespace halfway::stability

int main(int argc, char** argv) {
  using namespace halfway;
  using namespace halfway::stability;
  const auto searches = all_searches();
  Options options;
  CLI::App app{"Tests random inputs; a failing input is reduced, printed and stored", "halfway_search"};
  app.add_flag("--quick", options.quick, "few inputs of each search");
  app.add_option("--seed", options.seed, "other inputs")->capture_default_str();
  for (const auto& search : searches)
    app.add_option_function<std::uint64_t>(
        fmt::format("--{}", search->name()),
        [&options, name = search->name()](std::uint64_t count) { options.counts[name] = count; },
        "run this search with this number of inputs; searches without such an option do not run");
  app.add_option("--page", options.page, "page whose sections of searches are written");
  app.add_option("--keep", options.keep, "folder for inputs that fail");
  app.add_option("--replay", options.replay, "checks the inputs of this folder instead");
  app.add_option("SOURCE", options.source, "the project's root")->required();
  int exit_code = 0;
  app.callback([&] {
    options.source = std::filesystem::absolute(options.source);
    exit_code =
        static_cast<int>(options.replay.empty() ? run_all(searches, options) : replay(searches, options));
  });
  return cli::run_program(app, argc, argv, exit_code);
}

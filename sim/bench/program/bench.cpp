// SPDX-License-Identifier: Apache-2.0
#include "sim/bench/program/bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "sim/scene_files/load_scene.hpp"
#include "sim/system/seconds.hpp"

namespace halfway {

Scene builtin(const char* name) {
  return must(load_scene(name, c_source / "sim" / "scenes"));
}

bool is_wanted(const std::string& name) {
  const std::string filter = benchmark::GetBenchmarkFilter();
  if (filter.empty() || filter == "all") return true;
  return filter.front() == '-' ? !std::regex_search(name, std::regex(filter.substr(1)))
                               : std::regex_search(name, std::regex(filter));
}

std::string figure(double value) {
  if (value == 0) return "0";
  return fmt::format("{:.{}f}", value, value >= 100 ? 0 : value >= 10 ? 1 : 2);
}

std::string percent(double part) {
  return fmt::format("{:.1f} %", 100.0 * part);
}

std::string count(std::uint64_t n) {
  std::string text = std::to_string(n);
  for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, 1, ' ');
  return text;
}

double median(std::vector<double> all) {
  std::ranges::sort(all);
  const std::size_t half = all.size() / 2;
  return all.size() % 2 != 0 ? all[half] : 0.5 * (all[half - 1] + all[half]);
}

Pace::Pace()
    : work_(must(make_batches(builtin("spheres"), {560, 420}, {.shader = Shader::quadratic}))),
      golden_(make_golden_model(work_.key)) {}

double Pace::take() {
  constexpr int c_times = 4;
  const double start = process_seconds();
  for (int i = 0; i < c_times; ++i) {
    fragments_.clear();
    golden_->draw(work_.words, fragments_);
  }
  return (process_seconds() - start) / c_times;
}

void Measurements::add(const std::string& name, int repetitions, std::function<Counters()> go) {
  const auto measure = [this, name, go = std::move(go)](benchmark::State& state) {
    for (auto _ : state) {
      const double before = pace_.take();
      const Counters counters = go();
      const double after = pace_.take(), seconds = counters.at("seconds");
      best_pace_ = std::min({best_pace_, before, after});
      for (const auto& [counter, value] : counters) state.counters[counter] = value;
      state.counters["paces"] = seconds / (0.5 * (before + after));
      state.SetIterationTime(seconds);
      fmt::print(stderr, "{}: {:.4g} s\n", name, seconds);
    }
  };
  benchmark::RegisterBenchmark(name.c_str(), measure)
      ->UseManualTime()
      ->Iterations(1)
      ->Repetitions(repetitions)
      ->ComputeStatistics("best", [](const std::vector<double>& all) { return std::ranges::min(all); })
      ->DisplayAggregatesOnly()
      ->Unit(benchmark::kMillisecond);
}

void Measurements::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs)
    if (run.run_type == Run::RT_Aggregate)
      for (const auto& [counter, value] : run.counters)
        statistics_[{run.run_name.function_name, run.aggregate_name, counter}] = value;
  ConsoleReporter::ReportRuns(runs);
}

std::optional<double> Measurements::statistic(const std::string& name, const std::string& statistic,
                                              const std::string& counter) const {
  const auto found = statistics_.find({name, statistic, counter});
  return found == statistics_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<double> Measurements::seconds(const std::string& name) const {
  const auto paces = statistic(name, "median", "paces");
  return paces ? std::optional(*paces * best_pace_) : std::nullopt;
}

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// Shared by the parts of halfway_bench: folders, repeated measurements, number formats. Errors are thrown as
// Failure.
#pragma once

#include <benchmark/benchmark.h>

#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "golden_run/golden_run.hpp"
#include "scene/scene.hpp"
#include "sim/bench/workload.hpp"
#include "sim/ghdl/ghdl_library.hpp"
#include "sim/system/must.hpp"

namespace halfway {

using Json = nlohmann::ordered_json;

inline const std::filesystem::path c_source = HALFWAY_SOURCE_DIR;
inline const SimulatorFolders c_folders{c_source, c_source / "build" / "cache"};
inline const std::filesystem::path c_scratch = c_source / "build" / "bench";

Scene builtin(const char* name);
/// True if --benchmark_filter matches the name.
bool is_wanted(const std::string& name);

/// Three significant digits.
std::string figure(double value);
/// "12.3 %"
std::string percent(double part);
/// "1 000 000"
std::string count(std::uint64_t n);
/// `all` must not be empty.
double median(std::vector<double> all);

/// A fixed piece of work, timed repeatedly to determine the current speed of this core of a shared machine.
class Pace {
 public:
  Pace();
  const InitBatches& work() const { return work_; }
  /// Run the work and return its processor seconds.
  double take();

 private:
  InitBatches work_;
  std::unique_ptr<GoldenModel> golden_;
  std::vector<Fragment> fragments_;
};

/// Measurements that Google Benchmark repeats in random order, and their statistics.
class Measurements : public benchmark::ConsoleReporter {
 public:
  using Counters = std::map<std::string, double>;

  Measurements() : ConsoleReporter(OO_None) {}
  /// `go` returns processor seconds as "seconds", and other counters.
  void add(const std::string& name, int repetitions, std::function<Counters()> go);
  void run() { benchmark::RunSpecifiedBenchmarks(this); }

  bool has(const std::string& name) const { return statistic(name, "mean", "seconds").has_value(); }
  /// Statistic "mean", "median" or "best" of a counter; std::nullopt if it was not measured.
  std::optional<double> statistic(const std::string& name, const std::string& statistic,
                                  const std::string& counter) const;
  /// Median of all repetitions, each scaled to the machine's best speed during the run.
  std::optional<double> seconds(const std::string& name) const;
  const Pace& pace() const { return pace_; }

  void ReportRuns(const std::vector<Run>& runs) override;

 private:
  Pace pace_;
  double best_pace_ = std::numeric_limits<double>::infinity();
  std::map<std::tuple<std::string, std::string, std::string>, double> statistics_;
};

// Sections of the page. Each writes its data into `speed`.

class WayTable {
 public:
  WayTable(Measurements& measurements, unsigned jobs);
  void write(Json& speed) const;
  /// Speed-up by several threads.
  void write_cores(Json& speed) const;

 private:
  struct Column {
    Scene scene;
    InitBatches batches, ghdl_batches;
  };
  Measurements& measurements_;
  std::vector<Column> columns_;
};

class Growth {
 public:
  Growth(Measurements& measurements, unsigned jobs);
  ~Growth();
  void write(Json& speed) const;

 private:
  struct Series;
  Measurements& measurements_;
  std::vector<Series> series_;
};

/// Counts clocks; measures no time.
void measure_small_triangles(Json& speed);
/// Run `make sim` in an unchanged tree. Returns true if nothing was rebuilt.
bool measure_make(Json& speed);
/// Whole frames from scene to picture, ours and Mesa's, in turn.
void measure_whole_frames(Json& speed);
/// Not without Chromium.
void measure_browser(Json& speed);
/// Frames per second, as printed by `halfway view`.
void measure_view(Json& speed);

/// Append rows to the table of cores: `batches` processed by 1 to 4 threads.
void measure_cores(const char* shader, const InitBatches& batches, Json& rows);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// Shared by the parts of halfway_bench: folders, repeated measurements, number formats. Errors are thrown as
// Failure.
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "golden_run/golden_run.hpp"
#include "scene/scene.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/extras/bench/workload.hpp"
#include "sim/os/must.hpp"

namespace halfway {

using Json = nlohmann::ordered_json;

inline const std::filesystem::path c_source = HALFWAY_SOURCE_DIR;
inline const SimulatorFolders c_folders{c_source, c_source / "build" / "cache"};
inline const std::filesystem::path c_scratch = c_source / "build" / "bench";

Scene builtin(const char* name);

/// Three significant digits.
std::string figure(double value);
/// `all` must not be empty.
double median(std::vector<double> all);

/// Repeats measurements in random order. The speed of a shared machine's cores varies, so a fixed piece of
/// work is timed before and after each measurement.
class Measurements {
 public:
  Measurements();
  /// `go` returns processor seconds.
  void add(const std::string& name, int repetitions, std::function<double()> go);
  void run();
  /// Median of all repetitions, each scaled to the machine's best speed during the run; std::nullopt if it
  /// was not measured.
  std::optional<double> seconds(const std::string& name) const;

 private:
  struct Measured {
    std::function<double()> go;
    int repetitions;
    std::vector<double> paces{};  // a repetition's time, relative to that of the fixed work
  };
  double take_pace();

  GoldenStream work_;
  std::unique_ptr<GoldenModel> golden_;
  double best_pace_ = std::numeric_limits<double>::infinity();
  std::map<std::string, Measured> all_;
};

// Sections of the page. Each writes its data into `speed`.

/// All ways to draw a picture. `jobs`: builds at a time.
void measure_ways(Json& speed, unsigned jobs);
/// Counts clocks; measures no time.
void measure_small_triangles(Json& speed);
/// Run `make sim` in an unchanged tree. Throws Failure if something was built.
void measure_make(Json& speed);
/// Whole frames from scene to picture, ours and Mesa's, in turn.
void measure_whole_frames(Json& speed);
/// Not without Chromium.
void measure_browser(Json& speed);
/// Frames per second, as printed by `halfway view`.
void measure_view(Json& speed);

}  // namespace halfway

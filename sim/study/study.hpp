// SPDX-License-Identifier: Apache-2.0
// A study measures every point of a design space and determines which are worth building.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/cost/families.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/study/design_point.hpp"
#include "sim/study/record.hpp"

namespace halfway::study {

struct StudySettings {
  std::string scene;  ///< as for load_scene
  std::vector<DesignPoint> points;
  std::filesystem::path out;  ///< records of all studies are in out/points, tables in out
  unsigned threads = 1;
  /// The sequence of pieces (study.cpp) is cut into `parts`. Only part `part` is measured. Part 0 of 1: all.
  std::size_t part = 0, parts = 1;
  SimulatorFolders folders;
  /// Drawable::hardware, if its placements are pieces of the study too. They are cut into parts separately,
  /// because each takes as long as many points.
  std::vector<DesignPoint> placed;
  const synth::Family* family = &synth::c_default_family;  ///< of the device for these placements
  /// The worker for host_instructions. Empty: do not count instructions.
  std::vector<std::string> set_up;
  bool host_times = false;  ///< also measure Measurement::host_time; only in a run of all parts
  /// Called after each piece. Points measured earlier count as done.
  std::function<void(const std::string&)> on_progress = [](const std::string&) {};
};

struct Study {
  Provenance provenance;
  /// in the order of the points; for one part: its points as far as they are measured
  std::vector<Record> records;
  std::size_t measured = 0;     ///< measured in this run
  std::size_t drawn_tiles = 0;  ///< in this run
  std::size_t placements = 0;   ///< made in this run
};

/// The points of which the scene can be drawn. Each reason for omitting points is listed once.
struct Drawable {
  std::vector<DesignPoint> points;
  std::vector<DesignPoint> hardware;  ///< one of `points` for each hardware
  std::size_t left_out = 0;
  std::vector<std::string> reasons;
};
Drawable drawable(const std::vector<DesignPoint>& points, const std::string& scene,
                  const SimulatorFolders& folders);

/// Largest useful number of parts: the number of pieces or of placements.
std::size_t most_parts(const StudySettings& settings);

/// The parts that have pieces without a stored result.
std::vector<std::size_t> open_parts(const StudySettings& settings);

/// Measure all points without a stored result, on all threads. Each record is written as soon as it is
/// complete, so that an interrupted run can be continued. The first failing piece ends the study. In a run of
/// one part, points that need missing tiles of other parts are not assembled.
Study run_study(const StudySettings& settings);

}  // namespace halfway::study

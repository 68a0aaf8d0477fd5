// SPDX-License-Identifier: Apache-2.0
// A study: every point of a design space measured, and which of them are worth building.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "sim/ghdl/ghdl_library.hpp"
#include "sim/study/design_point.hpp"
#include "sim/study/record.hpp"

namespace halfway::study {

struct StudySettings {
  std::string scene;  ///< as load_scene takes it
  std::vector<DesignPoint> points;
  std::filesystem::path out;  ///< records of all studies lie in out/points, tables in out
  unsigned threads = 1;
  /// Pieces (pieces.hpp) that follow each other are cut into `parts`; measured is only this one's. All: part
  /// 0 of 1.
  std::size_t part = 0, parts = 1;
  SimulatorFolders folders;
  /// Drawable::hardware, where its placements are pieces of the study, too: cut into parts by themselves, as
  /// each takes as long as many points.
  std::vector<DesignPoint> placed;
  /// What host_instructions takes as its worker. Empty: they are not counted.
  std::vector<std::string> set_up;
  /// Told what is done; points that were measured before count.
  std::function<void(const std::string&)> on_progress = [](const std::string&) {};
  /// Told at once which file was damaged, and what was made anew for it.
  std::function<void(const std::string&)> on_note = [](const std::string&) {};
};

struct Study {
  Provenance provenance;
  std::vector<Record> records;  ///< in the points' order; of the part alone, as far as they are there
  std::size_t measured = 0;     ///< of these anew, in this run
  std::size_t drawn_tiles = 0;  ///< in this run
  std::size_t placements = 0;   ///< likewise
};

/// The points that can be drawn of the scene. What is left out is told: each reason once.
struct Drawable {
  std::vector<DesignPoint> points;
  std::vector<DesignPoint> hardware;  ///< of these, one of each hardware
  std::size_t left_out = 0;
  std::vector<std::string> reasons;
};
Drawable drawable(std::vector<DesignPoint> points, const std::string& scene, const SimulatorFolders& folders);

/// For more parts than this there is no use: how many pieces there are of points, or of placements.
std::size_t most_parts(const StudySettings& settings);

/// Numbers of the parts with pieces that were not measured before.
Result<std::vector<std::size_t>> open_parts(const StudySettings& settings);

/// Measures what was not measured before, on all threads. Each piece's record is written as it comes, so that
/// a run that is broken off goes on where it was. The first piece that fails ends the study. Of a part, what
/// has to be put together of tiles that are not there is left open.
Result<Study> run_study(const StudySettings& settings);

}  // namespace halfway::study

// SPDX-License-Identifier: Apache-2.0
// The report: one self-contained HTML page made from the results of the other commands.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway::report {

struct ReportSettings {
  std::filesystem::path page;  ///< output file; front.svg and front.csv of the study are written next to it
  std::filesystem::path results;  ///< results of sim: <scene>/<shader>/
  std::filesystem::path study;    ///< results of study: study.csv, points/
  std::filesystem::path figures;  ///< results of figures: figures.json and pictures
  SimulatorFolders folders;
  /// scenes that are reported as missing if a shader has no frame of them
  std::vector<std::string> scenes{};
  bool timing = true;  ///< simulate in GHDL for timing diagrams
  std::function<void(const std::string& what)> on_progress = [](const std::string&) {};
};

struct Report {
  std::size_t frames = 0, points = 0, figures = 0;
  std::size_t bytes = 0;
  std::vector<std::string> notes;  ///< missing parts and the commands that make them
};

/// Write the page atomically. Missing results are noted on the page. Throws Failure if results are damaged.
Report write_report(const ReportSettings& settings);

}  // namespace halfway::report

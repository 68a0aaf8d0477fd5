// SPDX-License-Identifier: Apache-2.0
// The report: one HTML page with everything in it, made of what the other commands left.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway::report {

struct ReportSettings {
  std::filesystem::path page;     ///< the file to write; beside it front.svg and front.csv, of the study
  std::filesystem::path results;  ///< what sim left: <scene>/<shader>/
  std::filesystem::path study;    ///< what study left: study.csv, points/
  std::filesystem::path figures;  ///< what figures left: figures.json and its pictures
  SimulatorFolders folders;
  std::vector<std::string> scenes{};  ///< whose frames are missed where a shader's are not there
  bool timing = true;                 ///< simulate in GHDL for timing diagrams
  std::function<void(const std::string& what)> on_progress = [](const std::string&) {};
};

struct Report {
  std::size_t frames = 0, points = 0, figures = 0;
  std::size_t bytes = 0;
  std::vector<std::string> notes;  ///< what is missing in it, and the command that makes it
};

/// Writes the page, whole or not at all. What was not made yet is noted in it, too; what is damaged is an
/// error.
Result<Report> write_report(const ReportSettings& settings);

}  // namespace halfway::report

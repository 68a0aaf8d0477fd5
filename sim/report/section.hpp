// SPDX-License-Identifier: Apache-2.0
// Shared by the sections of the report.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "sim/os/must.hpp"
#include "sim/report/report.hpp"

namespace halfway::report {

using Json = nlohmann::ordered_json;

/// The page under construction.
struct Page {
  const ReportSettings& settings;
  Report report;
  Json view;                      ///< values for report.html.mustache, by section
  Json data;                      ///< data for the page's script
  std::filesystem::path scratch;  ///< a folder for intermediate files

  /// Note that a result is missing. Returns an entry for a section's list `missing`.
  Json lacks(const std::string& what, const std::string& command);
};

// Each function adds the section of its name.
void add_frames(Page& page);  ///< and "effects"
void add_study(Page& page);
void add_figures(Page& page);
void add_hardware(Page& page);

}  // namespace halfway::report

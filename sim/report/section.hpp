// SPDX-License-Identifier: Apache-2.0
// What sections of the report share.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "sim/report/report.hpp"

namespace halfway::report {

using Json = nlohmann::ordered_json;

/// The page in the making.
struct Page {
  const ReportSettings& settings;
  Report report;
  Json view;                      ///< what page.html.mustache shows, by section
  Json data;                      ///< for the page's script
  std::filesystem::path scratch;  ///< a folder for intermediate files

  /// Notes what is missing: an entry for a section's list `missing`.
  Json lacks(const std::string& what, const std::string& command);
};

// Each fills in the section of its name.
Status add_frames(Page& page);  ///< and "effects"
Status add_study(Page& page);
Status add_figures(Page& page);
Status add_hardware(Page& page);
Status add_pages(Page& page);  ///< stability, proofs, mutants and the rest

}  // namespace halfway::report

// SPDX-License-Identifier: Apache-2.0
// What sections of the report share.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sim/report/report.hpp"

namespace halfway::report {

using Json = nlohmann::ordered_json;

/// The page in the making.
struct Page {
  const ReportSettings& settings;
  Report report;
  std::map<std::string, std::string> parts;  ///< HTML, by the template's marks
  Json data;                                 ///< for the page's script
  std::filesystem::path scratch;             ///< a folder for what goes on the way

  /// Notes what is missing; as HTML for its place.
  std::string lacks(const std::string& what, const std::string& command);
};

// A section each; they fill in the part of their name.
Status add_frames(Page& page);  ///< and "effects"
Status add_study(Page& page);
Status add_figures(Page& page);
Status add_hardware(Page& page);
Status add_pages(Page& page);  ///< stability, proofs, mutants and the rest

/// A `table` in a box that scrolls, of cells that are HTML; `caption` names both.
std::string table(const std::string& caption, const std::vector<std::string>& head,
                  const std::vector<std::vector<std::string>>& rows);

}  // namespace halfway::report

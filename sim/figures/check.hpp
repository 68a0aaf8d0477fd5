// SPDX-License-Identifier: Apache-2.0
// Checks that the committed figures are up to date.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "sim/figures/figure.hpp"

namespace halfway::figures {

/// Compare the page, figures.json and the pictures in `folder` with those drawn into `drawn_folder`. Returns
/// one sentence per difference. Rows that were not measured are taken from figures.json, except for their
/// verdicts. Plots made by another version of gnuplot are not compared; `notes` lists them.
Result<std::vector<std::string>> stale(std::span<const Entry> drawn, const std::filesystem::path& folder,
                                       const std::filesystem::path& drawn_folder,
                                       const std::filesystem::path& source, std::vector<std::string>& notes);

}  // namespace halfway::figures

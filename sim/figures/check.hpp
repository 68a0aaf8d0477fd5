// SPDX-License-Identifier: Apache-2.0
// Whether the committed figures are what is drawn and measured.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "sim/figures/figure.hpp"

namespace halfway::figures {

/// Compares the page, figures.json and the pictures in `folder` with what was drawn into `drawn_folder`: a
/// sentence for each difference. Rows that were not measured are taken from figures.json, but for their
/// verdicts. Plots of another gnuplot than this machine's are not compared, which `notes` says.
Result<std::vector<std::string>> stale(std::span<const Entry> drawn, const std::filesystem::path& folder,
                                       const std::filesystem::path& drawn_folder,
                                       const std::filesystem::path& source, std::vector<std::string>& notes);

}  // namespace halfway::figures

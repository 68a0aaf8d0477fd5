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

/// What is wrong with the rows, a sentence each: faults of single ones, rows that are missing, rows of no
/// claim.
std::vector<std::string> faults(std::span<const Figure> figures, std::span<const Entry> entries);

/// The page and figures.json in `folder`, and its pictures, beside what was drawn quickly into
/// `drawn_folder`: a sentence for each that is another. Rows of slow claims stand as they are, but for their
/// verdicts. Plots of another gnuplot than the one here are not compared; `notes` tells.
Result<std::vector<std::string>> stale(std::span<const Figure> figures, const std::filesystem::path& folder,
                                       std::span<const Entry> drawn,
                                       const std::filesystem::path& drawn_folder,
                                       std::vector<std::string>& notes);

}  // namespace halfway::figures

// SPDX-License-Identifier: Apache-2.0
// The front in one plot: of the designs that draw one picture, what each costs and how far off it is.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "common/result.hpp"
#include "sim/report/plot.hpp"
#include "sim/system/csv.hpp"

namespace halfway::report {

/// What sets a point's hardware apart, but for sizes of tables and thresholds: one series of a plot.
std::string series_of(const Table& table, std::size_t row);
/// What points of equal pictures share.
std::string picture_of(const Table& table, std::size_t row);
/// What none is both less and better than: the lower left of the points that are not aside, from left to
/// right.
std::vector<std::pair<double, double>> lower_left(const std::vector<PlotPoint>& points);

/// The picture that most of a study's hardware draws, as picture_of has it; empty where there is no hardware.
std::string commonest_picture(const Table& study);
/// Of a study's table that picture's designs, in the columns that say what a design is,
/// costs and errs by, and what all that is of. No rows where there is no hardware.
Table front_of(const Table& study);
/// Error against cells, or where they were not counted against clocks, as an SVG. Bad input where there is
/// nothing to plot.
Result<std::string> draw_front(const Table& front, const std::filesystem::path& scratch);
/// README's part "front": the picture with what its line joins, in words. Bad input where not all is counted.
Result<std::string> readme_front(const Table& front);
/// Writes front.csv and, drawn from it, front.svg; neither where there is nothing to plot. How many designs.
Result<std::size_t> write_front(const Table& study, const std::filesystem::path& folder,
                                const std::filesystem::path& scratch);

}  // namespace halfway::report

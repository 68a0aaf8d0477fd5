// SPDX-License-Identifier: Apache-2.0
// One plot of the designs that draw the same picture: error against cost, with the Pareto front.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sim/os/csv.hpp"
#include "sim/report/linked_plot.hpp"

namespace halfway::report {

/// False if the point is software.
bool is_hardware(const Table& table, std::size_t row);
/// Name of a point's series in a plot: its hardware without table sizes and thresholds.
std::string series_of(const Table& table, std::size_t row);
/// The picture is filtered, and its error is against a filtered reference.
bool is_filtered(const Table& table, std::size_t row);
/// Text that is equal for points of the same scene and size, filtered or not.
std::string frame_of(const Table& table, std::size_t row);
/// Text that is equal for points with equal pictures, and so the same reference.
std::string picture_of(const Table& table, std::size_t row);
/// The lower left boundary of the points that are not `aside`: those that no other point beats in both axes,
/// from left to right.
std::vector<std::pair<double, double>> lower_left(const std::vector<PlotPoint>& points);

/// picture_of the picture that most of a study's hardware draws; empty without hardware.
std::string commonest_picture(const Table& study);
/// The rows of a study's table with that picture, with the columns for design, cost, error and origin.
/// Without hardware there are no rows.
Table front_of(const Table& study);
/// Error against cells (against clocks if cells were not counted), as an SVG. Throws Failure if there is
/// nothing to plot.
std::string draw_front(const Table& front, const std::filesystem::path& scratch);
/// The part "front" of docs/accuracy.md: the picture and the designs on its line, in words. Throws
/// Failure if a cost is missing.
std::string page_front(const Table& front);
/// Writes front.csv and front.svg, or nothing if there is nothing to plot. Returns the number of designs.
std::size_t write_front(const Table& study, const std::filesystem::path& folder,
                        const std::filesystem::path& scratch);

}  // namespace halfway::report

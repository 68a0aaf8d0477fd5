// SPDX-License-Identifier: Apache-2.0
// What accuracy costs in time: the designs of a study's times.csv as plots, tables and sentences.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/os/csv.hpp"

namespace halfway::report {

/// The rows of each picture of times.csv, as tables of their own, the smallest picture first.
std::vector<Table> pictures_of(const Table& times);
/// Name of a picture's plot, such as times-sphere-640x480.svg.
std::string plot_name(const Table& picture);

/// README's part "times": plot, front and sentences for the first picture. Throws Failure with fewer
/// than two designs of hardware on the front.
std::string readme_times(const Table& times);
/// The part "times" of docs/accuracy.md: every design of every picture, the quickest first.
std::string page_times(const Table& times);

/// Writes times.csv and the plots: rms error against milliseconds per frame, host and hardware overlapped.
/// Returns the number of designs.
std::size_t write_times(const Table& times, const std::filesystem::path& folder,
                        const std::filesystem::path& scratch);

}  // namespace halfway::report

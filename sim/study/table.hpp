// SPDX-License-Identifier: Apache-2.0
// A study as CSV tables: a line with the names of the columns, then one line per point. Unknown values are
// empty. sim/study/spaces/README.md describes the columns.
#pragma once

#include <span>
#include <string>

#include "sim/study/frame_time.hpp"
#include "sim/study/hardware.hpp"
#include "sim/study/query.hpp"
#include "sim/study/record.hpp"

namespace halfway::study {

/// study.csv: all points. The column for the Pareto front is computed from `markets`.
std::string study_csv(const Provenance& provenance, std::span<const Record> records,
                      const HardwareTable& hardware, std::span<const Market> markets);

/// times.csv: the points with a known time.
std::string times_csv(const Provenance& provenance, std::span<const Record> records,
                      std::span<const PictureTimes> pictures);

}  // namespace halfway::study

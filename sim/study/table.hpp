// SPDX-License-Identifier: Apache-2.0
// A study as a CSV table.
#pragma once

#include <span>
#include <string>

#include "sim/study/hardware.hpp"
#include "sim/study/query.hpp"
#include "sim/study/record.hpp"

namespace halfway::study {

/// A header line with the names of the columns, then one line per point. sim/study/spaces/README.md describes
/// the columns. Unknown values are empty. The column for the Pareto front is computed from `markets`.
std::string to_csv(const Provenance& provenance, std::span<const Record> records,
                   const HardwareTable& hardware, std::span<const Market> markets);

}  // namespace halfway::study

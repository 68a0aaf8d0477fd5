// SPDX-License-Identifier: Apache-2.0
// A study as one table.
#pragma once

#include <span>
#include <string>

#include "sim/study/hardware.hpp"
#include "sim/study/query.hpp"
#include "sim/study/record.hpp"

namespace halfway::study {

/// One line a point, the names of the columns first. Columns are told in sim/studies/README.md; what is not
/// known is empty. Whether a point is on its picture's front is worked out here, from `markets`.
std::string to_csv(const Provenance& provenance, std::span<const Record> records,
                   const HardwareTable& hardware, std::span<const Market> markets);

}  // namespace halfway::study

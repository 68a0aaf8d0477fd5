// SPDX-License-Identifier: Apache-2.0
// Tables of studies (sim/study/spaces/README.md) on a page.
#pragma once

#include <span>
#include <string>

#include "sim/os/csv.hpp"

namespace halfway::page {

/// The rows of the tables in Markdown: scene, design, errors and costs. Columns that have the same value in
/// all rows are omitted, except the largest error, which thresholds judge.
std::string study_table(std::span<const Table> tables);

}  // namespace halfway::page

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tables/cosine.hpp"

namespace halfway::tables {

/// The sizes of the cosine tables that this program was built with.
CosineSizes compiled_sizes();

}  // namespace halfway::tables

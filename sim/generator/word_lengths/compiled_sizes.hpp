// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "words/generator/cosine.hpp"

namespace halfway::tables {

/// The sizes of the cosine tables compiled into this program.
CosineSizes compiled_sizes();

}  // namespace halfway::tables

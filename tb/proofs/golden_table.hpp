// SPDX-License-Identifier: Apache-2.0
// The golden model's tables, which the ROMs must equal entry by entry.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/result.hpp"

namespace halfway::proofs {

struct GoldenTable {
  std::vector<std::uint64_t> entries;
  int entry_bits;
};

/// The table of the ROM `name` (`cosine` or `function`) with these generics; the error names what is wrong.
Result<GoldenTable> golden_table(std::string_view name,
                                 const std::vector<std::pair<std::string, std::string>>& generics);

}  // namespace halfway::proofs

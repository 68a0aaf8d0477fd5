// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/tables/cosine_rom.vhd: reads the generated table.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <span>

#include "golden/words.hpp"
#include "words/cosine_tables.hpp"

namespace halfway::golden {

class CosineRom {
 public:
  /// Without a table every sample is zero.
  CosineRom() = default;
  /// Uses one of the tables, which must outlive this object.
  CosineRom(bool exact, int power, const CosineSize& size,
            std::span<const CosineTable> tables = c_cosine_tables) {
    const auto table = std::find_if(tables.begin(), tables.end(), [&](const auto& t) {
      return t.exact == exact && t.power == power && t.size == size;
    });
    assert(table != tables.end() && "there is no such table: make tables");
    entries_ = table->entries;
  }

  std::uint32_t sample(std::uint32_t address) const { return entries_.empty() ? 0 : entries_[address]; }

 private:
  std::span<const std::uint16_t> entries_;
};

}  // namespace halfway::golden

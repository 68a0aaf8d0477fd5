// SPDX-License-Identifier: Apache-2.0
// Cosine tables of sizes that the program was not built with: for the golden model here, for the RTL as a
// copy of its sources.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "common/result.hpp"
#include "golden/cosine_tables.hpp"
#include "tables/cosine.hpp"
#include "tables/word_lengths.hpp"

namespace halfway::tables {

/// All powers of one preset's size, by the generator of those that are compiled in.
class MadeTables {
 public:
  /// The size must be one that cosine_table takes.
  MadeTables(bool exact, CosineSize size);
  MadeTables(const MadeTables&) = delete;
  MadeTables& operator=(const MadeTables&) = delete;

  std::span<const golden::CosineTable> tables() const { return tables_; }

 private:
  std::vector<std::vector<std::uint16_t>> entries_;
  std::vector<golden::CosineTable> tables_;
};

/// Whether the program was built with tables of that size.
bool compiled_in(bool exact, CosineSize size);

/// A folder in the cache that stands for the checkout: its sim/ and tb/, and its rtl/ with what is asked for
/// in the preset: tables of that size alone, other word lengths.
Result<std::filesystem::path> rtl_with(bool exact, const std::optional<CosineSize>& size,
                                       const WordLengths& words, const std::filesystem::path& checkout,
                                       const std::filesystem::path& cache);

/// The same with tables alone.
Result<std::filesystem::path> rtl_with_tables(bool exact, CosineSize size,
                                              const std::filesystem::path& checkout,
                                              const std::filesystem::path& cache);

}  // namespace halfway::tables

// SPDX-License-Identifier: Apache-2.0
// Cosine tables of sizes that are not compiled into the program: in memory for the golden model, and as a
// copy of the RTL's sources.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "words/cosine_tables.hpp"
#include "words/generator/cosine.hpp"
#include "words/generator/word_lengths.hpp"

namespace halfway::tables {

/// Tables of one size for all powers of a preset, made by the generator of the compiled tables.
class MadeTables {
 public:
  /// `size` must be one that cosine_table accepts. `own`: as in CosineSizes.
  MadeTables(bool exact, CosineSize size, const std::vector<double>& own = {});
  MadeTables(const MadeTables&) = delete;
  MadeTables& operator=(const MadeTables&) = delete;

  std::span<const words::CosineTable> tables() const { return tables_; }

 private:
  std::vector<std::vector<std::uint16_t>> entries_;
  std::vector<words::CosineTable> tables_;
};

/// The sizes of the cosine tables compiled into this program.
CosineSizes compiled_sizes();
/// True if the program contains tables of that size.
bool compiled_in(bool exact, CosineSize size);

/// A cached copy of the checkout: its sim/ and tb/, and its rtl/ with the given changes to the preset: only
/// tables of that size (`own`: as in CosineSizes), other word lengths.
std::filesystem::path rtl_with(bool exact, const std::optional<CosineSize>& size, const WordLengths& words,
                               const std::filesystem::path& checkout, const std::filesystem::path& cache,
                               const std::vector<double>& own = {});

}  // namespace halfway::tables

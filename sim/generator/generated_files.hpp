// SPDX-License-Identifier: Apache-2.0
// The generated files of the checkout, the check that they are current, and the C++ headers that the build
// generates from the same sources.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "words/generator/cosine.hpp"
#include "words/generator/word_lengths.hpp"

namespace halfway::tables {

struct GeneratedFile {
  std::filesystem::path path;  ///< relative to the checkout's root, or to a folder of headers
  std::string text;
  std::string source = "model/words/generator";  ///< what to edit
};

/// The files for this checkout. halfway.core is made only if the checkout has rtl/files.f, the files of
/// registers only if it has rtl/core/core_registers.toml, and a page only if the checkout has it. Throws
/// Failure.
std::vector<GeneratedFile> generated_files(const std::filesystem::path& checkout, const CosineSizes& sizes);

/// words/formats.hpp, words/cosine_tables.hpp and words/function_tables.hpp. `words`: lengths of preset
/// exact, or of published, other than its own.
std::vector<GeneratedFile> cpp_headers(const CosineSizes& sizes, bool exact = true,
                                       const WordLengths& words = {});
/// The C header of the registers of halfway_core. Throws Failure.
GeneratedFile registers_header(const std::filesystem::path& checkout);
/// Write these files into the folder. Files that are already equal keep their times.
Status write_files(const std::filesystem::path& folder, const std::vector<GeneratedFile>& files);

/// The sizes of the checkout's cosine tables in VHDL; the default if it has none.
CosineSizes sizes_of(const std::filesystem::path& checkout);

/// The first line where the checkout's file differs from the generated one; 0 if the files are equal.
std::size_t first_different_line(const std::filesystem::path& checkout, const GeneratedFile& file);

/// "path:line: not what the generator writes; ..." for each file of the checkout that differs. Without
/// `all` only for what a simulation is made of: no pages, no files for users. Throws Failure.
std::vector<std::string> stale_files(const std::filesystem::path& checkout, const CosineSizes& sizes,
                                     bool all = true);

}  // namespace halfway::tables

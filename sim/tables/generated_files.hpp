// SPDX-License-Identifier: Apache-2.0
// All generated files, and the check that a checkout's copies are current.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tables/cosine.hpp"

namespace halfway::tables {

struct GeneratedFile {
  std::filesystem::path path;  ///< relative to the checkout's root
  std::string text;
};

/// The files for this checkout. halfway.core is made only if the checkout has rtl/files.f.
std::vector<GeneratedFile> generated_files(const std::filesystem::path& checkout, const CosineSizes& sizes);

/// The first line where the checkout's file differs from the generated one; 0 if the files are equal.
std::size_t first_different_line(const std::filesystem::path& checkout, const GeneratedFile& file);

/// "path:line: not what the generator writes; ..." for each file of the checkout that differs. Without
/// `all` only for sources.
std::vector<std::string> stale_files(const std::filesystem::path& checkout, const CosineSizes& sizes,
                                     bool all = true);

}  // namespace halfway::tables

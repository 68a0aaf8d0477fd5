// SPDX-License-Identifier: Apache-2.0
// Every generated file, and whether a checkout's are as the generator writes them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tables/cosine.hpp"

namespace halfway::tables {

struct GeneratedFile {
  std::filesystem::path path;  ///< from the checkout's root
  std::string text;
};

std::vector<GeneratedFile> generated_files(const CosineSizes& sizes);

/// The first line in which the checkout's file is not the generated one; 0 where there is none.
std::size_t first_different_line(const std::filesystem::path& checkout, const GeneratedFile& file);

/// "path:line: not what the generator writes; ..." for each file of the checkout that differs.
std::vector<std::string> stale_files(const std::filesystem::path& checkout, const CosineSizes& sizes);

}  // namespace halfway::tables

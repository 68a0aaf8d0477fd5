// SPDX-License-Identifier: Apache-2.0
#include "sim/tables/generated_files.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/system/file.hpp"
#include "tables/formats.hpp"
#include "tables/functions.hpp"
#include "tables/layout_page.hpp"

namespace halfway::tables {

std::vector<GeneratedFile> generated_files(const CosineSizes& sizes) {
  const auto presets = preset_formats();
  return {{"rtl/tables/formats_pkg.vhd", vhdl_package(presets)},
          {"model/golden/formats.hpp", cpp_header(presets)},
          {"rtl/tables/cosine_pkg.vhd", cosine_vhdl_package(sizes)},
          {"model/golden/cosine_tables.hpp", cosine_cpp_header(sizes)},
          {"rtl/tables/function_pkg.vhd", function_vhdl_package()},
          {"model/golden/function_tables.hpp", function_cpp_header()},
          {"docs/rtl/init-vectors.md", layout_page(presets)}};
}

std::size_t first_different_line(const std::filesystem::path& checkout, const GeneratedFile& file) {
  const Result<std::string> present = read_file(checkout / file.path);
  if (!present) return 1;
  if (*present == file.text) return 0;
  const auto [here, there] = std::ranges::mismatch(*present, file.text);
  return 1 + static_cast<std::size_t>(std::count(present->begin(), here, '\n'));
}

std::vector<std::string> stale_files(const std::filesystem::path& checkout, const CosineSizes& sizes,
                                     bool pages) {
  std::vector<std::string> messages;
  for (const GeneratedFile& file : generated_files(sizes)) {
    if (!pages && file.path.extension() == ".md") continue;
    if (const std::size_t line = first_different_line(checkout, file); line != 0)
      messages.push_back(
          fmt::format("{}:{}: not what the generator writes; edit model/tables, then run `make tables`",
                      file.path.string(), line));
  }
  return messages;
}

}  // namespace halfway::tables

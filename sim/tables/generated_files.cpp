// SPDX-License-Identifier: Apache-2.0
#include "sim/tables/generated_files.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/system/file.hpp"
#include "sim/tables/core_file.hpp"
#include "tables/formats.hpp"
#include "tables/functions.hpp"
#include "tables/layout_page.hpp"

namespace halfway::tables {

std::vector<GeneratedFile> generated_files(const std::filesystem::path& checkout, const CosineSizes& sizes) {
  const auto presets = preset_formats();
  std::vector<GeneratedFile> files = {{"rtl/tables/formats_pkg.vhd", vhdl_package(presets)},
                                      {"model/golden/formats.hpp", cpp_header(presets)},
                                      {"rtl/tables/cosine_pkg.vhd", cosine_vhdl_package(sizes)},
                                      {"model/golden/cosine_tables.hpp", cosine_cpp_header(sizes)},
                                      {"rtl/tables/function_pkg.vhd", function_vhdl_package()},
                                      {"model/golden/function_tables.hpp", function_cpp_header()},
                                      {"docs/rtl/init-vectors.md", layout_page(presets)}};
  if (const auto list = read_file(checkout / "rtl/files.f"))
    files.push_back({"halfway.core", core_text(*list, HALFWAY_VERSION)});
  return files;
}

std::size_t first_different_line(const std::filesystem::path& checkout, const GeneratedFile& file) {
  const Result<std::string> present = read_file(checkout / file.path);
  if (!present) return 1;
  if (*present == file.text) return 0;
  const auto [here, there] = std::ranges::mismatch(*present, file.text);
  return 1 + static_cast<std::size_t>(std::count(present->begin(), here, '\n'));
}

std::vector<std::string> stale_files(const std::filesystem::path& checkout, const CosineSizes& sizes,
                                     bool all) {
  std::vector<std::string> messages;
  for (const GeneratedFile& file : generated_files(checkout, sizes)) {
    if (!all && (file.path.extension() == ".md" || file.path.extension() == ".core")) continue;
    if (const std::size_t line = first_different_line(checkout, file); line != 0)
      messages.push_back(fmt::format("{}:{}: not what the generator writes; edit {}, then run `make tables`",
                                     file.path.string(), line,
                                     file.path.extension() == ".core" ? "rtl/files.f" : "model/tables"));
  }
  return messages;
}

}  // namespace halfway::tables

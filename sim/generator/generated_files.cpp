// SPDX-License-Identifier: Apache-2.0
#include "sim/generator/generated_files.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/generator/core_file.hpp"
#include "sim/os/file.hpp"
#include "words/generator/formats.hpp"
#include "words/generator/functions.hpp"
#include "words/generator/layout_page.hpp"

namespace halfway::tables {

std::vector<GeneratedFile> generated_files(const std::filesystem::path& checkout, const CosineSizes& sizes) {
  const auto presets = preset_formats();
  std::vector<GeneratedFile> files = {{"rtl/tables/formats_pkg.vhd", vhdl_package(presets)},
                                      {"rtl/tables/cosine_pkg.vhd", cosine_vhdl_package(sizes)},
                                      {"rtl/tables/function_pkg.vhd", function_vhdl_package()},
                                      {"docs/rtl/init-vectors.md", layout_page(presets)}};
  if (const auto list = read_file(checkout / "rtl/files.f"))
    files.push_back({"halfway.core", core_text(*list, HALFWAY_VERSION)});
  return files;
}

std::vector<GeneratedFile> cpp_headers(const CosineSizes& sizes, bool exact, const WordLengths& words) {
  return {{"words/formats.hpp", cpp_header(preset_formats(exact, words))},
          {"words/cosine_tables.hpp", cosine_cpp_header(sizes)},
          {"words/function_tables.hpp", function_cpp_header(function_tables(exact, words))}};
}

Status write_files(const std::filesystem::path& folder, const std::vector<GeneratedFile>& files) {
  for (const auto& [path, text] : files) {
    if (const auto present = read_file(folder / path); present && *present == text) continue;
    if (Status made = make_folders((folder / path).parent_path()); !made) return made;
    if (Status written = write_file(folder / path, text); !written) return written;
  }
  return Ok{};
}

CosineSizes sizes_of(const std::filesystem::path& checkout) {
  const auto package = read_file(checkout / "rtl/tables/cosine_pkg.vhd");
  const CosineSizes sizes = package ? cosine_sizes_in(*package) : CosineSizes{};
  return sizes.exact.empty() || sizes.published.empty() ? CosineSizes{} : sizes;
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
      messages.push_back(fmt::format(
          "{}:{}: not what the generator writes; edit {}, then run `make tables`", file.path.string(), line,
          file.path.extension() == ".core" ? "rtl/files.f" : "model/words/generator"));
  }
  return messages;
}

}  // namespace halfway::tables

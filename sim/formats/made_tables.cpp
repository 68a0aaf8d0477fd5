// SPDX-License-Identifier: Apache-2.0
#include "sim/formats/made_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "sim/formats/compiled_sizes.hpp"
#include "sim/system/file.hpp"
#include "tables/formats.hpp"
#include "tables/functions.hpp"

namespace halfway::tables {
namespace {

namespace fs = std::filesystem;

// Paths relative to rtl/, and the files' contents.
using Packages = std::map<std::string, std::string>;

CosineSizes sizes_with(bool exact, CosineSize size, const std::vector<double>& own) {
  CosineSizes sizes;
  sizes.own = own;
  (exact ? sizes.exact : sizes.published) = {size};
  return sizes;
}

struct Source {
  fs::path path;  // relative to rtl/
  std::string text;
};

Result<std::vector<Source>> rtl_sources(const fs::path& rtl, const Packages& packages) {
  const auto files = files_below(rtl);
  if (!files) return files.error();
  std::vector<Source> sources;
  for (const fs::path& path : *files) {
    auto text = read_file(rtl / path);
    if (!text) return text.error();
    const auto made = packages.find(path.string());
    sources.push_back({path, made != packages.end() ? made->second : *text});
  }
  return sources;
}

}  // namespace

MadeTables::MadeTables(bool exact, CosineSize size, const std::vector<double>& own) {
  for (const CosineTable& made : cosine_tables(sizes_with(exact, size, own))) {
    if (made.exact != exact) continue;
    // Entries have at most 12 bits.
    std::vector<std::uint16_t> entries;
    for (const std::uint32_t entry : made.entries) entries.push_back(static_cast<std::uint16_t>(entry));
    entries_.push_back(std::move(entries));
    tables_.push_back({exact, made.power, made.address_bits, made.data_bits, entries_.back()});
  }
}

bool compiled_in(bool exact, CosineSize size) {
  const CosineSizes sizes = compiled_sizes();
  const auto& list = exact ? sizes.exact : sizes.published;
  return std::ranges::find(list, size) != list.end();
}

Result<fs::path> rtl_with_tables(bool exact, CosineSize size, const fs::path& checkout,
                                 const fs::path& cache) {
  return rtl_with(exact, size, {}, checkout, cache);
}

Result<fs::path> rtl_with(bool exact, const std::optional<CosineSize>& size, const WordLengths& words,
                          const fs::path& checkout, const fs::path& cache, const std::vector<double>& own) {
  Packages packages;
  std::string name = exact ? "exact" : "published";
  if (size) {
    packages["tables/cosine_pkg.vhd"] = cosine_vhdl_package(sizes_with(exact, *size, own));
    name += fmt::format("-{}x{}{}", size->address_bits, size->data_bits, own.empty() ? "" : "-own");
  }
  if (words.any()) {
    packages["tables/formats_pkg.vhd"] = vhdl_package(preset_formats(exact, words));
    packages["tables/function_pkg.vhd"] = function_vhdl_package(function_tables(exact, words));
    name += "-" + words.name();
  }
  const auto sources = rtl_sources(checkout / "rtl", packages);
  if (!sources) return sources.error();
  ContentHash hash;
  hash.add(fs::absolute(checkout).string());
  for (const Source& source : *sources) hash.add(source.path.string()).add(source.text);
  const fs::path parent = fs::absolute(cache) / "tables";
  const fs::path folder = parent / fmt::format("{}-{}", name, hash.hex());
  if (fs::exists(folder)) return folder;
  auto fresh = TemporaryFolder::make(parent);
  if (!fresh) return fresh.error();
  for (const Source& source : *sources) {
    const fs::path path = fresh->path() / "rtl" / source.path;
    if (Status made = make_folders(path.parent_path()); !made) return made.error();
    if (Status written = write_file(path, source.text); !written) return written.error();
  }
  for (const char* kept : {"sim", "tb"}) {
    std::error_code error;
    fs::create_directory_symlink(fs::absolute(checkout) / kept, fresh->path() / kept, error);
    if (error) return tool_failed(fmt::format("{}: {}", fresh->path().string(), error.message()));
  }
  if (Status moved = fresh->move_to(folder); !moved) return moved.error();
  return folder;
}

}  // namespace halfway::tables

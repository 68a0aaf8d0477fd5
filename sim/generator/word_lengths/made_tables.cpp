// SPDX-License-Identifier: Apache-2.0
#include "sim/generator/word_lengths/made_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "sim/os/file.hpp"
#include "words/generator/formats.hpp"
#include "words/generator/functions.hpp"

namespace halfway::tables {
namespace {

namespace fs = std::filesystem;

CosineSizes sizes_with(bool exact, CosineSize size, const std::vector<double>& own) {
  CosineSizes sizes;
  sizes.own = own;
  (exact ? sizes.exact : sizes.published) = {size};
  return sizes;
}

}  // namespace

MadeTables::MadeTables(bool exact, CosineSize size, const std::vector<double>& own) {
  for (const CosineTable& made : cosine_tables(sizes_with(exact, size, own))) {
    if (made.exact != exact) continue;
    // Entries have at most 12 bits.
    std::vector<std::uint16_t> entries;
    for (const std::uint32_t entry : made.entries) entries.push_back(static_cast<std::uint16_t>(entry));
    entries_.push_back(std::move(entries));
    tables_.push_back({exact, made.power, made.size, entries_.back()});
  }
}

bool compiled_in(bool exact, CosineSize size) {
  return std::ranges::any_of(words::c_cosine_tables, [&](const words::CosineTable& table) {
    return table.exact == exact && table.size == size;
  });
}

CosineSizes compiled_sizes() {
  CosineSizes sizes{{}, {}};
  for (const words::CosineTable& table : words::c_cosine_tables) {
    auto& list = table.exact ? sizes.exact : sizes.published;
    if (std::ranges::find(list, table.size) == list.end()) list.push_back(table.size);
  }
  return sizes;
}

fs::path rtl_with(bool exact, const std::optional<CosineSize>& size, const WordLengths& words,
                  const fs::path& checkout, const fs::path& cache, const std::vector<double>& own) {
  std::map<fs::path, std::string> sources;  // by their paths relative to rtl/
  for (const fs::path& path : must(files_below(checkout / "rtl")))
    sources[path] = must(read_file(checkout / "rtl" / path));
  std::string name = exact ? "exact" : "published";
  if (size) {
    sources["tables/cosine_pkg.vhd"] = cosine_vhdl_package(sizes_with(exact, *size, own));
    name += fmt::format("-{}{}", to_string(*size), own.empty() ? "" : "-own");
  }
  if (words.any()) {
    sources["tables/formats_pkg.vhd"] = vhdl_package(preset_formats(exact, words));
    sources["tables/function_pkg.vhd"] = function_vhdl_package(function_tables(exact, words));
    name += "-" + words.name();
  }
  ContentHash hash;
  hash.add(fs::absolute(checkout).string());
  for (const auto& [path, text] : sources) hash.add(path.string()).add(text);
  const fs::path folder = fs::absolute(cache) / "tables" / fmt::format("{}-{}", name, hash.hex());
  make_once(folder, [&](const fs::path& fresh) {
    for (const auto& [path, text] : sources) must(write_file(fresh / "rtl" / path, text));
    for (const char* kept : {"sim", "tb"}) {
      std::error_code error;
      fs::create_directory_symlink(fs::absolute(checkout) / kept, fresh / kept, error);
      if (error) throw_tool_failed("{}: {}", fresh.string(), error.message());
    }
  });
  return folder;
}

}  // namespace halfway::tables

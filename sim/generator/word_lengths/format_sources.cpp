// SPDX-License-Identifier: Apache-2.0
#include "sim/generator/word_lengths/format_sources.hpp"

#include <fmt/format.h>

#include "sim/os/file.hpp"

namespace halfway {

std::vector<std::string> format_sources(Shader shader) {
  return {"sim/generator/word_lengths/formats_harness.cpp", "model/setup/half_triangle.cpp",
          "model/setup/walk_header.cpp", fmt::format("model/setup/{}_setup.cpp", to_string(shader))};
}

std::string format_sources_hash(const std::filesystem::path& source) {
  std::vector<std::filesystem::path> files;
  for (const Shader shader : c_shaders)
    for (const std::string& file : format_sources(shader)) files.emplace_back(file);
  for (const auto& header : must(files_below(source / "model", ".hpp"))) files.push_back("model" / header);
  ContentHash hash;
  for (const std::filesystem::path& file : files) hash.add(file.string()).add(must(read_file(source / file)));
  return hash.hex();
}

}  // namespace halfway

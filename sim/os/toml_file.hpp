// SPDX-License-Identifier: Apache-2.0
// Files of TOML. An error of the syntax names file and line.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway {

/// `file` is for messages. Throws Failure.
inline toml::table parse_toml(std::string_view text, const std::string& file) {
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw_bad_input("{}:{}: {}", file, error.source().begin.line, error.description());
  }
}

/// The table of a file. Throws Failure.
inline toml::table read_toml(const std::filesystem::path& file) {
  return parse_toml(must(read_file(file)), file.string());
}

}  // namespace halfway

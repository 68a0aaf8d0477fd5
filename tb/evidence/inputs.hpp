// SPDX-License-Identifier: Apache-2.0
// What a measurement depends on, without the parts that do not change it.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"

namespace halfway::evidence {

/// C++ without comments and without white space outside of literals.
std::string bare_cpp(std::string_view text);

/// Hash of the C++ files of these folders, without tests, each as bare_cpp. `folders` are relative to `root`
/// and separated by colons.
Result<std::string> sources_hash(const std::filesystem::path& root, std::string_view folders);

/// The first lines that the tools print for `--version`. An error names the package that is missing.
Result<std::string> versions(std::span<const std::string_view> tools);

/// Hash of a program: the versions of the tools that it runs, and its sources.
Result<std::string> program_hash(std::span<const std::string_view> tools, const std::filesystem::path& root,
                                 std::string_view folders);

}  // namespace halfway::evidence

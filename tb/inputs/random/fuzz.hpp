// SPDX-License-Identifier: Apache-2.0
// Common parts of the fuzz targets: the input as a file, and the end of the process if a guarantee does not
// hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "common/result.hpp"

/// libFuzzer calls this function for each input; replay.cpp calls it for each file. Returns 0, or -1 for an
/// input that need not be kept.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace halfway::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A folder for this process only, empty at first.
const std::filesystem::path& folder();

/// Writes the bytes to a file of that name in the folder.
std::filesystem::path write_input(std::string_view name, std::string_view bytes);

/// Aborts the process if the condition does not hold.
void demand(bool holds, std::string_view what);

/// Requires that an error about a file in the folder has exit code 2 and starts with the file's name.
void demand_refusal(const Error& error);

}  // namespace halfway::fuzz

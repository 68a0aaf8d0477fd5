// SPDX-License-Identifier: Apache-2.0
// What the fuzz targets share: the input as a file, and how a broken promise ends the process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "common/result.hpp"

/// What libFuzzer calls for each input; replay.cpp calls it for each file. Gives 0, or -1 for an input that
/// is not worth keeping.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace halfway::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// This process's own folder, empty at first.
const std::filesystem::path& folder();

/// The bytes as a file of that name in the folder.
std::filesystem::path write_input(std::string_view name, std::string_view bytes);

/// Ends the process, as a crash, where the condition does not hold.
void demand(bool holds, std::string_view what);

/// What an error about a file in the folder owes its reader: exit code 2, and the file's name first.
void demand_refusal(const Error& error);

}  // namespace halfway::fuzz

// SPDX-License-Identifier: Apache-2.0
// Checksums in the files of a study, to detect damaged files when the study continues.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "common/result.hpp"

namespace halfway::study {

/// XXH64 of the file in hexadecimal, as `xxh64sum` prints it.
Result<std::string> checksum_of(const std::filesystem::path& file);

/// The object as text with its own checksum as the last member.
std::string sealed(nlohmann::ordered_json object);
/// The object without the checksum; std::nullopt if the text is not as `sealed` wrote it.
std::optional<nlohmann::ordered_json> unsealed(const std::string& text);

}  // namespace halfway::study

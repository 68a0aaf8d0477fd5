// SPDX-License-Identifier: Apache-2.0
// What a study keeps bears checksums: where a byte has become another, that is noticed when the study goes
// on.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "common/result.hpp"

namespace halfway::study {

/// Of all bytes of the file: XXH64 in hexadecimal, as `xxh64sum` prints it.
Result<std::string> checksum_of(const std::filesystem::path& file);

/// The object as text, its own checksum at the end.
std::string sealed(nlohmann::ordered_json object);
/// The object without that checksum; none where a byte is not as `sealed` wrote it.
std::optional<nlohmann::ordered_json> unsealed(const std::string& text);

}  // namespace halfway::study

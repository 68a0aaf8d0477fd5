// SPDX-License-Identifier: Apache-2.0
// Testbenches that are pure rows in, rows out: each is written from the entity's ports and
// tb/vectors/rows.toml.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace halfway::rows {

/// The text of NAME_tb.vhd, by the names of the entities in tb/vectors/rows.toml. Throws Failure.
std::map<std::string, std::string> testbenches(const std::filesystem::path& source);

}  // namespace halfway::rows

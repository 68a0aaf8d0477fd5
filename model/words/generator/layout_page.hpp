// SPDX-License-Identifier: Apache-2.0
// The tables of docs/rtl/init-vectors.md, which list every field of the vectors that the host sends.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "words/generator/formats.hpp"

namespace halfway::tables {

/// The page's parts, by name: for each vector or block its fields with bits, format and meaning.
std::vector<std::pair<std::string, std::string>> layout_tables(const std::vector<PresetFormats>& presets);

}  // namespace halfway::tables

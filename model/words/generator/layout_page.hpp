// SPDX-License-Identifier: Apache-2.0
// The page that lists every field of the vectors that the host sends: docs/rtl/init-vectors.md.
#pragma once

#include <string>
#include <vector>

#include "words/generator/formats.hpp"

namespace halfway::tables {

/// Markdown: for each vector its fields with bits, format, meaning and the source that computes them.
std::string layout_page(const std::vector<PresetFormats>& presets);

}  // namespace halfway::tables

// SPDX-License-Identifier: Apache-2.0
// Texts of VHDL without comments, and the hash of the RTL that a page names.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/result.hpp"

namespace halfway {

/// VHDL without comments, in lower case outside of literals, with one space for white space: equal for equal
/// tokens.
std::string bare_vhdl(std::string_view text);

/// Hash of the sources of rtl/files.f, each as bare_vhdl.
Result<std::string> rtl_hash(const std::filesystem::path& source_folder);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// The core file of FuseSoC (CAPI2): the RTL for other designs.
#pragma once

#include <string>
#include <string_view>

namespace halfway::tables {

/// The text of halfway.core. `files`: the text of rtl/files.f.
std::string core_text(std::string_view files, std::string_view version);

}  // namespace halfway::tables

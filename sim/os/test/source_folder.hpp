// SPDX-License-Identifier: Apache-2.0
// The root of the checkout, for tests.
#pragma once

#include <filesystem>

namespace halfway {

inline const std::filesystem::path c_source_folder = HALFWAY_SOURCE_DIR;

}  // namespace halfway

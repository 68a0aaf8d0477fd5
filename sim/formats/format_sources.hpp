// SPDX-License-Identifier: Apache-2.0
// What a library of other formats is compiled from at run time, and the program that loads it was built from:
// where the two are not the same, neither's objects are laid out as the other takes them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "plan/hardware_key.hpp"

namespace halfway {

/// From the project's root: all that takes a format's width and that makes init vectors or fragments; what
/// these call besides is the program's own.
std::vector<std::string> format_sources(Shader shader);

/// Of a checkout's: the sources of all shaders, and every header under model/.
Result<std::string> format_sources_hash(const std::filesystem::path& source);

/// The same of the checkout that this program was built from, as it was then. Written by the build.
const char* built_from();

}  // namespace halfway

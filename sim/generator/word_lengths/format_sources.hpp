// SPDX-License-Identifier: Apache-2.0
// Sources from which a library of other formats is compiled at run time. The program must have been built
// from the same sources; otherwise the object layouts of program and library may differ.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plan/hardware_key.hpp"

namespace halfway {

/// Paths relative to the project's root: all sources that depend on a format's width, and all that make init
/// vectors or fragments. Other functions that these call are the program's own.
std::vector<std::string> format_sources(Shader shader);

/// Hash over a checkout: the sources of all shaders and every header under model/.
std::string format_sources_hash(const std::filesystem::path& source);

/// The same hash of the checkout that this program was built from, at build time. The build generates this
/// function.
const char* built_from();

}  // namespace halfway

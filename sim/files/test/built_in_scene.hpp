// SPDX-License-Identifier: Apache-2.0
// The scenes of sim/scenes, for tests.
#pragma once

#include <string>

#include "sim/files/load_scene.hpp"
#include "sim/os/must.hpp"
#include "sim/os/test/source_folder.hpp"

namespace halfway {

inline const std::filesystem::path c_built_in_scenes = c_source_folder / "sim" / "scenes";

inline constexpr const char* c_built_in_names[] = {"spheres", "highlights", "teapot",
                                                   "lights",  "matte",      "shadows"};

inline Scene built_in_scene(const std::string& name, const LoadOptions& options = {}) {
  return must(load_scene(name, c_built_in_scenes, options));
}

}  // namespace halfway

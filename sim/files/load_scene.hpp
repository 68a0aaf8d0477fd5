// SPDX-License-Identifier: Apache-2.0
// Loads a valid scene from a name, a scene file or a mesh file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"
#include "scene/scene.hpp"
#include "scene_files/parse_scene.hpp"

namespace halfway {

/// Names of the scene files of a folder, in alphabetical order. Empty if it cannot be read.
std::vector<std::string> scene_names(const std::filesystem::path& folder);

/// Load a built-in scene by name (`teapot`: scenes_folder/teapot.toml), a scene file (.toml) as by
/// parse_scene with the mesh files that it names, or a single mesh file as by scene_of_mesh.
Result<Scene> load_scene(std::string_view name_or_path, const std::filesystem::path& scenes_folder,
                         const LoadOptions& options = {});

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// From a name, a scene file or a mesh file to a scene that is fit to be drawn.
#pragma once

#include <filesystem>
#include <string_view>

#include "common/result.hpp"
#include "scene/scene.hpp"

namespace halfway {

struct LoadOptions {
  /// Slices, stacks and divisions of spheres, teapots and boxes are as many times those that the scene names,
  /// rounded. A mesh file's triangles are what they are: another factor than 1 is an error there.
  double tessellation = 1.0;
};

/// Loads a built-in scene by name (`teapot`: scenes_folder/teapot.toml), a scene file (.toml), or a mesh file
/// alone, which gets a camera that sees all of it, one white light from the camera's upper left, and its own
/// or the default material.
///
/// What it promises of a scene: every number finite and in the range scene.hpp names, indices in range, unit
/// normals, a camera with a view (camera.hpp: has_view), 1 to c_max_triangles triangles, none of zero area.
/// Everything else is an error with the file and, where there is one, the line. What it mended stands in
/// Scene::notes.
///
/// The keys of a scene file are listed in sim/scenes/README.md.
Result<Scene> load_scene(std::string_view name_or_path, const std::filesystem::path& scenes_folder,
                         const LoadOptions& options = {});

}  // namespace halfway

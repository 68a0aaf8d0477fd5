// SPDX-License-Identifier: Apache-2.0
// Loads a valid scene from a name, a scene file or a mesh file.
#pragma once

#include <filesystem>
#include <string_view>

#include "common/result.hpp"
#include "scene/scene.hpp"

namespace halfway {

struct LoadOptions {
  /// Factor for slices, stacks and divisions of spheres, teapots and boxes; results are rounded. With a mesh
  /// file, a factor other than 1 is an error.
  double tessellation = 1.0;
};

/// Load a built-in scene by name (`teapot`: scenes_folder/teapot.toml), a scene file (.toml), or a single
/// mesh file. A mesh file gets a camera that sees all of it, one white light from the camera's upper left,
/// and its own or the default material.
/// Every loaded scene has: finite numbers within the ranges in scene.hpp, indices in range, unit normals, a
/// camera with a view (camera.hpp: has_view), and 1 to c_max_triangles triangles, none of zero area.
/// Everything else is an error with the file and, if known, the line. Scene::notes lists corrections.
/// The keys of a scene file are listed in sim/scenes/README.md.
Result<Scene> load_scene(std::string_view name_or_path, const std::filesystem::path& scenes_folder,
                         const LoadOptions& options = {});

}  // namespace halfway

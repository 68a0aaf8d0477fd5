// SPDX-License-Identifier: Apache-2.0
// Valid scenes from the text of a scene file, or from a single mesh.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "common/result.hpp"
#include "mesh_files/loaded_mesh.hpp"
#include "scene/scene.hpp"

namespace halfway {

struct LoadOptions {
  /// Factor for slices, stacks and divisions of spheres, teapots and boxes; results are rounded. With a mesh
  /// file, a factor other than 1 is an error.
  double tessellation = 1.0;
};

/// A mesh file that a scene file names.
struct MeshFile {
  std::string path;  ///< for messages
  /// Not empty: why the name is wrong. It follows "scene file:line: file of mesh ".
  std::string refusal;
  Result<LoadedMesh> mesh;  ///< an error has the prefix of the mesh file
};
/// Read the mesh file of this name, as it is written in the scene file.
using ReadMesh = std::function<MeshFile(std::string_view name)>;

/// Refuse a file that is too large for a scene.
Status check_scene_size(std::uintmax_t bytes, std::string_view file);

/// Read a scene file from its text. `file` is its name in messages; the scene has the name of the file
/// without its ending. Every loaded scene has: finite numbers within the ranges in scene.hpp, indices in
/// range, unit normals, a camera with a view (camera.hpp: has_view), and 1 to c_max_triangles triangles, none
/// of zero area. Everything else is an error with the file and, if known, the line. Scene::notes lists
/// corrections. The keys of a scene file are listed in sim/scenes/README.md.
Result<Scene> parse_scene(std::string_view text, std::string_view file, const ReadMesh& read_mesh,
                          const LoadOptions& options = {});

/// A scene of one mesh: a camera that sees all of it, one white light from the camera's upper left, and its
/// own or the default material.
Result<Scene> scene_of_mesh(LoadedMesh loaded, std::string_view file);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// Names of mesh files, and meshes from the bytes of a file.
#pragma once

#include <string>
#include <string_view>

#include "common/result.hpp"
#include "mesh_files/gltf.hpp"
#include "mesh_files/loaded_mesh.hpp"
#include "mesh_files/obj.hpp"

namespace halfway {

/// The last part of a path.
std::string_view file_name(std::string_view path);
/// The ending of a file's name with its dot, in lower case. A name that only starts with a dot has none.
std::string lower_ending(std::string_view path);
/// The file's name without its ending.
std::string file_stem(std::string_view path);

/// What is said of a file with another ending, where a mesh, or a mesh or a scene file, is wanted.
inline constexpr std::string_view c_no_mesh_file =
    "not a mesh file by its name; .obj, .ply, .stl, .gltf and .glb can be read";
inline constexpr std::string_view c_no_scene_file =
    "not a scene by its name; .toml, .obj, .ply, .stl, .gltf and .glb are";

/// True if the ending is that of a mesh file (.obj .ply .stl .gltf .glb in either case).
bool is_mesh_file_name(std::string_view path);

/// How the other files that a mesh file names are read.
struct OtherFiles {
  ReadLibrary library;
  ReadBuffer buffer;
};

/// Read a mesh by the ending of its file's name: read_obj, read_ply, read_stl, read_gltf.
Result<LoadedMesh> read_mesh(std::string_view bytes, std::string_view file, const OtherFiles& others);

}  // namespace halfway

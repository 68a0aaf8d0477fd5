// SPDX-License-Identifier: Apache-2.0
// Mesh files: OBJ (with MTL), PLY, STL, glTF 2.0.
#pragma once

#include <filesystem>

#include "common/result.hpp"
#include "mesh_files/loaded_mesh.hpp"

namespace halfway {

/// True if the ending is that of a mesh file (.obj .ply .stl .gltf .glb in either case).
bool is_mesh_file_name(const std::filesystem::path& path);

/// Read a mesh file by its ending: read_obj with its material libraries, read_ply, read_stl, read_gltf.
Result<LoadedMesh> load_mesh(const std::filesystem::path& path);

/// Checks for messages with a line number: the file exists, is a regular file and is not empty.
Status check_readable(const std::filesystem::path& path);

}  // namespace halfway

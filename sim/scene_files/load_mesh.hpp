// SPDX-License-Identifier: Apache-2.0
// Mesh files: OBJ (with MTL), PLY, STL, glTF 2.0.
#pragma once

#include <filesystem>
#include <string>

#include "common/result.hpp"
#include "mesh_files/loaded_mesh.hpp"

namespace halfway {

/// The ending of a file's name with its dot, in lower case.
std::string lower_ending(const std::filesystem::path& path);

/// True if the ending is that of a mesh file (.obj .ply .stl .gltf .glb in either case).
bool is_mesh_file_name(const std::filesystem::path& path);

/// Read a mesh file. Points and lines are omitted.
/// OBJ: read_obj, with its material libraries. PLY: read_ply. STL: read_stl.
/// glTF: node transforms are applied. The base colour becomes the
/// colour, and a roughness r the exponent 2 / r^4 - 2. The highlight of a metal has its colour. k_d and k_s
/// are those of the default material. Exponents below 1 become 1. A file without materials gets one default
/// material. Textures and vertex colours are omitted with a note. assimp reads these files in
/// halfway_mesh_reader, a separate process with limits on memory and time. If a damaged file crashes it, only
/// that process ends, and the file is an error.
Result<LoadedMesh> load_mesh(const std::filesystem::path& path);

/// Checks for messages with a line number: the file exists, is a regular file and is not empty.
Status check_readable(const std::filesystem::path& path);

}  // namespace halfway

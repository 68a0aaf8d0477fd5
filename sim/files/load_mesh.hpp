// SPDX-License-Identifier: Apache-2.0
// Mesh files: OBJ (with MTL), PLY, STL, glTF 2.0.
#pragma once

#include <filesystem>

#include "common/result.hpp"
#include "mesh_files/loaded_mesh.hpp"

namespace halfway {

/// Read a mesh file by its ending, with the material libraries and buffers that it names.
Result<LoadedMesh> load_mesh(const std::filesystem::path& path);

/// Checks for messages with a line number: the file exists, is a regular file and is not empty.
Status check_readable(const std::filesystem::path& path);

}  // namespace halfway

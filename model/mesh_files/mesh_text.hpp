// SPDX-License-Identifier: Apache-2.0
// Names of mesh files, and meshes from the text or bytes of a file.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "common/result.hpp"
#include "mesh_files/loaded_mesh.hpp"
#include "mesh_files/obj.hpp"

namespace halfway {

/// The last part of a path.
std::string_view file_name(std::string_view path);
/// The ending of a file's name with its dot, in lower case. A name that only starts with a dot has none.
std::string lower_ending(std::string_view path);
/// The file's name without its ending.
std::string file_stem(std::string_view path);

/// The endings that read_mesh_text accepts.
inline constexpr std::array<std::string_view, 3> c_mesh_text_endings = {".obj", ".ply", ".stl"};
bool is_mesh_text_name(std::string_view path);

/// Read a mesh by the ending of its file's name: read_obj, read_ply, read_stl.
Result<LoadedMesh> read_mesh_text(std::string_view bytes, std::string_view file,
                                  const ReadLibrary& read_library);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// What assimp does not check, or not before it takes the memory: counts, indices, numbers, lengths.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/result.hpp"

namespace halfway {

/// What a look through the file found; assimp must find the same.
struct MeshFileSummary {
  std::optional<std::uint64_t> polygons;       ///< faces of three corners or more, where the format tells
  std::optional<std::uint64_t> vertices;       ///< where assimp must deliver just as many
  std::vector<std::string> missing_libraries;  ///< OBJ: mtllib files that cannot be read
  bool has_materials = false;                  ///< OBJ: it names materials, and a library to read them from
};

/// Looks through a mesh file of an ending that `is_mesh_file_name` knows: OBJ, PLY and STL whole and in
/// constant memory, of glTF the JSON part.
Result<MeshFileSummary> check_mesh_file(const std::filesystem::path& path);

}  // namespace halfway

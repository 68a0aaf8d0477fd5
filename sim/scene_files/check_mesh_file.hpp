// SPDX-License-Identifier: Apache-2.0
// Checks that assimp lacks or makes only after allocating memory: counts, indices, numbers, lengths.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "common/result.hpp"

namespace halfway {

/// Counts of a mesh file; assimp must find the same.
struct MeshFileSummary {
  /// faces with three corners or more, if the format gives their number
  std::optional<std::uint64_t> polygons;
  std::optional<std::uint64_t> vertices;  ///< if assimp must return the same number
};

/// Check the JSON part of a glTF file.
Result<MeshFileSummary> check_mesh_file(const std::filesystem::path& path);

}  // namespace halfway

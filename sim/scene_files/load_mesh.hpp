// SPDX-License-Identifier: Apache-2.0
// Mesh files: OBJ (with MTL), PLY, STL, glTF 2.0.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "scene/mesh.hpp"

namespace halfway {

/// Crease angle of a file without normals, unless the scene sets one. Every edge is smooth.
inline constexpr double c_smooth_crease_degrees = 180.0;
/// Default crease angle of STL, which has flat facets only and mostly describes machine parts.
inline constexpr double c_stl_crease_degrees = 60.0;

struct LoadedMesh {
  Mesh mesh;  ///< equal positions are merged; normals are zero if the file has none
  double default_crease_degrees = c_smooth_crease_degrees;
  std::vector<std::string> notes;  ///< "file: what was left out or changed"
};

/// True if the ending is that of a mesh file (.obj .ply .stl .gltf .glb in either case).
bool is_mesh_file_name(const std::filesystem::path& path);

/// Read a mesh file. Polygons are triangulated, node transforms applied, points and lines omitted.
/// MTL: Kd and Ks become the colours, with k_d = k_s = 1 (0 for black), Ns the exponent. glTF: the base
/// colour becomes the colour, and a roughness r the exponent 2 / r^4 - 2. The highlight of a metal has its
/// colour. k_d and k_s are those of the default material. Exponents below 1 become 1. A file without
/// materials gets one default material. Textures and vertex colours are omitted with a note.
/// assimp reads the file in halfway_mesh_reader, a separate process with limits on memory and time. If a
/// damaged file crashes it, only that process ends, and the file is an error.
Result<LoadedMesh> load_mesh(const std::filesystem::path& path);

/// Checks for messages with a line number: the file exists, is a regular file and is not empty.
Status check_readable(const std::filesystem::path& path);

}  // namespace halfway

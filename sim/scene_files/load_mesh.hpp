// SPDX-License-Identifier: Apache-2.0
// Mesh files: OBJ (with MTL), PLY, STL, glTF 2.0.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "scene/mesh.hpp"

namespace halfway {

/// Crease angle for a file without normals, unless the scene gives one: all of it is smooth.
inline constexpr double c_smooth_crease_degrees = 180.0;
/// The same for STL, which stores flat facets only and mostly machine parts.
inline constexpr double c_stl_crease_degrees = 60.0;

struct LoadedMesh {
  Mesh mesh;  ///< positions joined; zero normals where the file has none
  double default_crease_degrees = c_smooth_crease_degrees;
  std::vector<std::string> notes;  ///< "file: what was left out or changed"
};

/// Is this the name of a mesh file, by its ending (.obj .ply .stl .gltf .glb in either case)?
bool is_mesh_file_name(const std::filesystem::path& path);

/// Reads a mesh file: polygons in triangles, the nodes' transforms applied, points and lines left out.
///
/// MTL: Kd and Ks become the colours, with k_d = k_s = 1 (0 where the colour is black), Ns the exponent.
/// glTF: the base colour becomes the colour, roughness r the exponent 2 / r^4 - 2, a metal's highlight takes
/// its colour; k_d and k_s are those of the default material. Exponents below 1 become 1. A file without
/// materials gets one default material. Textures and vertex colours are left out, with a note.
///
/// assimp does the reading, in halfway_mesh_reader, a process with limits on memory and time: where a damaged
/// file breaks it, only that process ends, and the file is an error like any other.
Result<LoadedMesh> load_mesh(const std::filesystem::path& path);

/// Checks that can tell the line: does the file exist, is it a file, does it hold anything?
Status check_readable(const std::filesystem::path& path);

}  // namespace halfway

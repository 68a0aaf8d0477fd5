// SPDX-License-Identifier: Apache-2.0
// Result of reading a mesh file of any format.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scene/mesh.hpp"

namespace halfway {

/// Crease angle of a file without normals, unless the scene sets one. Every edge is smooth.
inline constexpr double c_smooth_crease_degrees = 180.0;
/// Default crease angle of STL, which has flat facets only and mostly describes machine parts.
inline constexpr double c_stl_crease_degrees = 60.0;
/// A triangle uses three vertices at most.
inline constexpr std::size_t c_max_vertices = 3 * std::size_t{c_max_triangles};

/// The lights of a file. Their greatest intensity is 1.
struct FileLights {
  std::vector<DirectionalLight> directional;
  std::vector<PositionalLight> positional;
  std::vector<SpotLight> spots;
  bool empty() const { return directional.empty() && positional.empty() && spots.empty(); }
};

struct LoadedMesh {
  Mesh mesh;  ///< equal positions are merged; normals are zero if the file has none
  FileLights lights;
  double default_crease_degrees = c_smooth_crease_degrees;
  std::vector<std::string> notes;  ///< "file: what was left out or changed"
};

/// The material of a file without materials.
inline Material default_material() {
  Material material;
  material.name = "default";
  return material;
}

}  // namespace halfway

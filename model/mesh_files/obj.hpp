// SPDX-License-Identifier: Apache-2.0
// Wavefront OBJ with MTL.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "common/result.hpp"
#include "mesh_files/loaded_mesh.hpp"

namespace halfway {

/// A material library that an OBJ file names.
struct MaterialLibrary {
  std::string path;                 ///< for messages
  std::optional<std::string> text;  ///< nothing if it cannot be read
};
/// Read the library of this name, as it is written after mtllib.
using ReadLibrary = std::function<MaterialLibrary(std::string_view name)>;

/// Read an OBJ file from its text. `file` is its name in messages; every refusal starts with "file:line: ".
///
/// Every word of v, f, l and p is checked, and a keyword that OBJ does not have is refused: after a dropped
/// line all indices would be wrong. A normal that cannot be read is computed; texture coordinates are not
/// read. Numbers are floats (mesh_files/number.hpp). A vertex has 3 numbers, or 4, of which the last divides
/// the others, or 6 and more, with a colour. Indices may be negative, or name vertices of later lines. Faces
/// are divided as in mesh_files/triangulate.hpp. A corner without a normal gets the normal 0. Positions are
/// in the order in which the faces use them, triangles in the order of the file.
///
/// A name goes to the end of the line. If only the part before " #" is defined, the rest is a comment.
/// Materials: Kd and Ks become the colours, with k_d = k_s = 1, or 0 for black; Ns the exponent. A material
/// without Kd or without a definition is grey (0.6). A file without usemtl, or of whose libraries none can be
/// read, gets one default material. Left out with a note: points, lines, curves, surfaces, textures, colours
/// of vertices. Groups, objects and smoothing groups have no effect.
Result<LoadedMesh> read_obj(std::string_view text, std::string_view file, const ReadLibrary& read_library);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// PLY, as text and binary of either byte order.
#pragma once

#include <string_view>

#include "common/result.hpp"
#include "mesh_files/loaded_mesh.hpp"

namespace halfway {

/// Read a PLY file from its bytes. `file` is its name in messages. Refusals of the header and of text start
/// with "file:line: ", those of binary data with "file: byte N: ".
///
/// Used: element vertex with x, y, z and, if given, nx, ny, nz; element face with one list vertex_indices or
/// vertex_index; element tristrips with the same list, in which -1 starts a new strip. Vertices must come
/// before what uses them, and a property may be given once. All types of PLY are read; numbers are rounded to
/// the nearest float. Faces are divided as in mesh_files/triangulate.hpp.
/// Other properties are skipped, other elements are left out with a note; in text they may be any words.
/// Every item of text is one line of exactly its numbers. Data after the last element is refused, except for
/// line ends. Left out with a note: faces of fewer than three corners, colours of vertices.
Result<LoadedMesh> read_ply(std::string_view bytes, std::string_view file);

}  // namespace halfway

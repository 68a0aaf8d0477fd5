// SPDX-License-Identifier: Apache-2.0
// STL, as text and binary.
#pragma once

#include <string_view>

#include "common/result.hpp"
#include "mesh_files/loaded_mesh.hpp"

namespace halfway {

/// Read an STL file from its bytes. `file` is its name in messages.
///
/// The file is binary if its size is 84 + 50 n bytes for the count n in its header; text of at most 4 GiB
/// cannot fulfil this. Otherwise it is text if it starts with "solid", or binary if it has more bytes.
/// Text: refusals start with "file:line: ". Keywords may be in either case, words on any line. There may be
/// several solids, each with its endsolid. A facet has exactly three vertices.
/// Coordinates are floats (mesh_files/number.hpp).
/// Binary: a coordinate that is not finite is refused with its facet and byte.
///
/// Normals of facets are not used: any words may stand there, or none. Colours of binary facets are left out
/// with a note. The mesh gets one default material.
Result<LoadedMesh> read_stl(std::string_view bytes, std::string_view file);

}  // namespace halfway

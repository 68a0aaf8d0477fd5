// SPDX-License-Identifier: Apache-2.0
// A hen: an organic shape in place of the papers' chicken, whose mesh was not published.
#pragma once

#include <cstdint>

#include "scene/mesh.hpp"

namespace halfway {

/// Closed, beak towards +x, y up, some 3 long and 3 high, with the shape's own normals: blobs that flow into
/// one another, cut into cells of 1/cells (`cells` >= 4, so that legs hold together). 6 make some 1500
/// triangles.
Mesh make_hen(std::uint32_t cells);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// A hen: an organic shape. It replaces the papers' chicken, whose mesh was not published.
#pragma once

#include <cstdint>

#include "scene/mesh.hpp"

namespace halfway {

/// Closed, beak towards +x, y up, about 3 long and 3 high, with the normals of the shape: ellipsoids and rods
/// blended into one another, in cells of size 1/cells. `cells` >= 4, so that the legs are connected. 6 gives
/// about 1500 triangles.
Mesh make_hen(std::uint32_t cells);

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// Pieces of a study. Any process may measure them, in any order.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sim/study/design_point.hpp"

namespace halfway::study {

/// A frame with tiles has one piece per tile, and one that assembles the point from them.
enum class PieceKind {
  point,           ///< a whole point without tiles
  reference_tile,  ///< a tile of the reference, shared by all points of the picture
  tile,            ///< a tile of the point's drawing
  gathering,       ///< assembles a point; needs the tiles of the reference and of the drawing
};

struct Piece {
  PieceKind kind;
  std::size_t point;       ///< index of the point; of a reference tile, the first point of the picture
  std::size_t points = 1;  ///< of a reference tile: number of consecutive points of the picture
  std::size_t tile = 0;    ///< index of the tile
};

/// In the order of the points. The reference tiles of a picture precede its points.
std::vector<Piece> pieces_of(std::span<const DesignPoint> points);

}  // namespace halfway::study

// SPDX-License-Identifier: Apache-2.0
// What a study is cut into: pieces that may be measured by anyone, in any order.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sim/study/design_point.hpp"

namespace halfway::study {

/// A frame that is cut into tiles has a piece for each, and one that puts the point together of them.
enum class PieceKind {
  point,           ///< all of one
  reference_tile,  ///< of the picture's reference, for all points of the picture
  tile,            ///< of the point's drawing
  gathering,       ///< when the picture's tiles and the point's are there
};

struct Piece {
  PieceKind kind;
  std::size_t point;       ///< by number; of a picture, its first
  std::size_t points = 1;  ///< of a picture: so many, one behind the other
  std::size_t tile = 0;    ///< by number
};

/// In the points' order; a picture's tiles stand before its points.
std::vector<Piece> pieces_of(std::span<const DesignPoint> points);

}  // namespace halfway::study

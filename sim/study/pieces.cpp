// SPDX-License-Identifier: Apache-2.0
#include "sim/study/pieces.hpp"

namespace halfway::study {

std::vector<Piece> pieces_of(std::span<const DesignPoint> points) {
  std::vector<Piece> pieces;
  std::size_t picture_end = 0;
  for (std::size_t point = 0; point < points.size(); ++point) {
    if (!points[point].in_tiles()) {
      pieces.push_back({.kind = PieceKind::point, .point = point});
      continue;
    }
    const std::size_t tiles = points[point].tiles().size();
    if (point >= picture_end) {
      const std::string picture = points[point].picture();
      for (picture_end = point; picture_end < points.size() && points[picture_end].picture() == picture;)
        ++picture_end;
      for (std::size_t tile = 0; tile < tiles; ++tile)
        pieces.push_back({PieceKind::reference_tile, point, picture_end - point, tile});
    }
    if (is_drawn(points[point].method))
      for (std::size_t tile = 0; tile < tiles; ++tile)
        pieces.push_back({.kind = PieceKind::tile, .point = point, .tile = tile});
    pieces.push_back({.kind = PieceKind::gathering, .point = point});
  }
  return pieces;
}

}  // namespace halfway::study

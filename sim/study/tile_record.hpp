// SPDX-License-Identifier: Apache-2.0
// Stored results of a tile: colours and masks as PNG, figures as JSON. Each file is written atomically, the
// JSON file last. The files of a drawing are removed when its point is assembled. Those of a reference stay
// for later points of the picture.
#pragma once

#include <cstddef>
#include <filesystem>
#include <utility>

#include "sim/study/measure.hpp"
#include "sim/study/pictures.hpp"
#include "sim/study/record.hpp"

namespace halfway::study {

/// A frame with tiles has one piece per tile, and one that assembles the point from them.
enum class PieceKind {
  point,           ///< a whole point without tiles
  reference_tile,  ///< a tile of the reference, shared by all points of the picture
  tile,            ///< a tile of the point's drawing
  gathering,       ///< assembles a point; needs the tiles of the reference and of the drawing
};

/// Tiles of one study in a folder. Tiles of another provenance are ignored.
class TileRecords {
 public:
  TileRecords(std::filesystem::path folder, Provenance provenance)
      : folder_(std::move(folder)), provenance_(std::move(provenance)) {}

  /// True if a tile is stored. `tile` is an index of DesignPoint::tiles. `kind` is reference_tile, shared by
  /// the points of a picture, or tile, of the point's own drawing.
  bool has(const DesignPoint& point, PieceKind kind, std::size_t tile) const;
  void add_reference(const DesignPoint& point, std::size_t tile, const Reference& reference) const;
  void add_drawing(const DesignPoint& point, std::size_t tile, const Drawing& drawing) const;

  /// Remove the tiles of the drawing of an assembled point; no other point uses them.
  void remove_drawing(const DesignPoint& point) const;

  /// True if all tiles for assembling the point are stored.
  bool complete(const DesignPoint& point) const;
  /// The reference of the whole frame.
  Reference reference(const DesignPoint& point) const;
  /// The drawing of the whole frame; figures are sums over the tiles.
  Drawing drawing(const DesignPoint& point) const;

 private:
  /// The colours and the masks of the whole frame.
  std::pair<Frame, Frame> put_together(const DesignPoint& point, PieceKind kind) const;
  std::filesystem::path file(const DesignPoint& point, PieceKind kind, std::size_t tile,
                             const char* ending) const;

  std::filesystem::path folder_;
  Provenance provenance_;
};

}  // namespace halfway::study

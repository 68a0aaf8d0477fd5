// SPDX-License-Identifier: Apache-2.0
// Stored results of a tile: colours and masks as PNG, figures and checksums as JSON. The JSON file is written
// last, each file atomically. The files of a drawing are removed when its point is assembled. Those of a
// reference stay for later points of the picture.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>

#include "common/result.hpp"
#include "sim/study/measure.hpp"
#include "sim/study/pictures.hpp"
#include "sim/study/pieces.hpp"
#include "sim/study/record.hpp"

namespace halfway::study {

/// Tiles of one study in a folder. Tiles of another provenance are ignored.
class TileRecords {
 public:
  TileRecords(std::filesystem::path folder, Provenance provenance)
      : folder_(std::move(folder)), provenance_(std::move(provenance)) {}

  /// True if a tile is stored. `tile` is an index of DesignPoint::tiles. `kind` is reference_tile, shared by
  /// the points of a picture, or tile, of the point's own drawing.
  bool has(const DesignPoint& point, PieceKind kind, std::size_t tile) const;
  Status add_reference(const DesignPoint& point, std::size_t tile, const Reference& reference) const;
  Status add_drawing(const DesignPoint& point, std::size_t tile, const Drawing& drawing) const;

  /// Remove the tiles of the drawing of an assembled point; no other point uses them.
  void remove_drawing(const DesignPoint& point) const;

  /// True if all tiles for assembling the point are stored.
  bool complete(const DesignPoint& point) const;
  /// Stores a tile again because the given file is damaged.
  using Redraw = std::function<Status(std::size_t tile, const std::filesystem::path& damaged)>;
  /// The reference of the whole frame.
  Result<Reference> reference(const DesignPoint& point, const Redraw& redraw) const;
  /// The drawing of the whole frame; figures are sums over the tiles.
  Result<Drawing> drawing(const DesignPoint& point, const Redraw& redraw) const;

 private:
  struct Whole;
  Result<Whole> put_together(const DesignPoint& point, PieceKind kind, const Redraw& redraw) const;
  std::filesystem::path file(const DesignPoint& point, PieceKind kind, std::size_t tile,
                             const char* ending) const;

  std::filesystem::path folder_;
  Provenance provenance_;
};

}  // namespace halfway::study

// SPDX-License-Identifier: Apache-2.0
// What a study keeps of a tile: colours and masks as PNG, figures and checksums as JSON. The JSON file comes
// last, and each is written whole or not at all. Those of a drawing go when the point is put together; those
// of a reference are for whichever point of the picture comes next.
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

/// Tiles of one study in a folder. What is not of its provenance is none of its.
class TileRecords {
 public:
  TileRecords(std::filesystem::path folder, Provenance provenance)
      : folder_(std::move(folder)), provenance_(std::move(provenance)) {}

  /// A tile by its number in DesignPoint::tiles: reference_tile, which points of one picture share, or tile,
  /// of the point's own drawing.
  bool has(const DesignPoint& point, PieceKind kind, std::size_t tile) const;
  Status add_reference(const DesignPoint& point, std::size_t tile, const Reference& reference) const;
  Status add_drawing(const DesignPoint& point, std::size_t tile, const Drawing& drawing) const;

  /// Of a point that is put together: nobody else reads them.
  void remove_drawing(const DesignPoint& point) const;

  /// All that the point is put together of is there.
  bool complete(const DesignPoint& point) const;
  /// Adds a tile, of which this file is damaged, anew.
  using Redraw = std::function<Status(std::size_t tile, const std::filesystem::path& damaged)>;
  /// The whole frame.
  Result<Reference> reference(const DesignPoint& point, const Redraw& redraw) const;
  /// The whole frame; figures are sums.
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

// SPDX-License-Identifier: Apache-2.0
// Stored results. Of a point: its frame as PNG, and its figures as JSON. Of a tile: colours and masks as PNG,
// figures as JSON.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "sim/study/design_point.hpp"
#include "sim/study/measure.hpp"

namespace halfway::study {

/// Everything that a point's results depend on, except the point itself. A record of another provenance is
/// not used, and the point is measured again.
struct Provenance {
  std::string scene;       ///< by name
  std::string scene_hash;  ///< over all numbers of the scene
  std::string program;     ///< hash of this program and of halfway_mesa
  std::string rtl;         ///< hash of every file of the RTL
  std::string tools;       ///< versions of the tools that simulate, count and compare
};
/// Hash of all numbers of the scene that affect a picture.
std::string scene_hash(const Scene& scene);

/// `scene` must have tessellation 1.
Provenance provenance_of(const Scene& scene, const SimulatorFolders& folders);

/// Results without the frame.
struct Record {
  DesignPoint point;
  Measurement measured;
};

/// Base name, without extension, of the files of the object called `name`, for example a point.
std::string record_name(const Provenance& provenance, const std::string& name);
std::string record_name(const Provenance& provenance, const DesignPoint& point);

/// A part of a study. A frame with tiles has one piece per tile, and one that assembles the point from them.
enum class PieceKind {
  point,           ///< a whole point without tiles
  reference_tile,  ///< a tile of the reference, shared by all points of the picture
  tile,            ///< a tile of the point's drawing
  gathering,       ///< assembles a point; needs the tiles of the reference and of the drawing
};

/// Records of one study in a folder: two files per point, three per tile. Those of another provenance are
/// ignored. Each file is written atomically, the JSON file last.
class Records {
 public:
  Records(std::filesystem::path folder, Provenance provenance)
      : folder_(std::move(folder)), provenance_(std::move(provenance)) {}

  /// std::nullopt if there is no readable record, or no frame.
  std::optional<Record> find(const DesignPoint& point) const;
  void add(const Record& record) const;
  /// Store the frame of a point before its record.
  void add_frame(const DesignPoint& point, const Frame& frame) const;
  std::filesystem::path file(const DesignPoint& point) const;
  std::filesystem::path picture(const DesignPoint& point) const;

  /// True if a tile is stored. `tile` is an index of DesignPoint::tiles. `kind` is reference_tile, shared by
  /// the points of a picture, or tile, of the point's own drawing.
  bool has_tile(const DesignPoint& point, PieceKind kind, std::size_t tile) const;
  void add_reference(const DesignPoint& point, std::size_t tile, const Reference& reference) const;
  void add_drawing(const DesignPoint& point, std::size_t tile, const Drawing& drawing) const;
  /// Remove the tiles of the drawing of an assembled point; no other point uses them. Those of the reference
  /// stay for later points of the picture.
  void remove_drawing(const DesignPoint& point) const;
  /// True if all tiles for assembling the point are stored.
  bool has_tiles(const DesignPoint& point) const;
  /// The reference of the whole frame, from its tiles.
  Reference reference(const DesignPoint& point) const;
  /// The drawing of the whole frame, from its tiles; figures are sums over them.
  Drawing drawing(const DesignPoint& point) const;

 private:
  /// The colours and the masks of the whole frame.
  std::pair<Frame, Frame> put_together(const DesignPoint& point, PieceKind kind) const;
  std::filesystem::path tile_file(const DesignPoint& point, PieceKind kind, std::size_t tile,
                                  const char* ending) const;

  std::filesystem::path folder_;
  Provenance provenance_;
};

}  // namespace halfway::study

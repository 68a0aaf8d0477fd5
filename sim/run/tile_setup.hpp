// SPDX-License-Identifier: Apache-2.0
// Of a frame's init vectors those that a tile of it takes.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "frame/tile.hpp"
#include "golden_run/golden_run.hpp"
#include "setup/setup.hpp"

namespace halfway {

/// The whole frame's vectors in its order, without the triangles that cover no pixel of the tile. A triangle
/// is never cut: each pixel of the tile is drawn by the same vectors as in the whole frame, from which it
/// gets the same fragments. Pixels beside the tile get some of theirs, and are not to be kept. So also where
/// lines go through the shading processors' object stage and shadow counters, which look at a pixel at a
/// time: a polygon that passes over a pixel of the tile is there for its depth, its shadow and its colour.
///
/// Of each unit one tile of a frame counts what it takes the host, that in which its reach begins: the tiles'
/// counts together are the frame's, whatever their size.
class TileSetup final : public Setup {
 public:
  /// `golden` is of the frame's hardware. `frame` must outlive this.
  TileSetup(const Setup& frame, std::unique_ptr<GoldenModel> golden, const Tile& tile);

  unsigned init_bits() const override { return frame_.init_bits(); }
  std::uint32_t units() const override { return static_cast<std::uint32_t>(units_.size()); }
  bool units_are_lines() const override { return frame_.units_are_lines(); }
  Tile reach(std::uint32_t unit) const override { return frame_.reach(units_[unit]); }
  void append_prologue(std::vector<std::uint32_t>& words, SetupCounts& counts) const override;
  void append(std::uint32_t unit, std::vector<std::uint32_t>& words, SetupCounts& counts) const override;
  std::vector<std::string> notes() const override { return frame_.notes(); }

 private:
  bool is_counted(const Tile& reach) const { return tile_.holds(reach.x, reach.y); }

  const Setup& frame_;
  Tile tile_;
  std::unique_ptr<GoldenModel> golden_;  ///< knows a triangle's vectors
  std::vector<std::uint32_t> units_;     ///< the frame's that touch the tile or are counted in it
};

}  // namespace halfway

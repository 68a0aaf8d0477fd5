// SPDX-License-Identifier: Apache-2.0
// Selects the init vectors of a frame that a tile of it needs.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "frame/tile.hpp"
#include "golden_run/golden_run.hpp"
#include "setup/setup.hpp"

namespace halfway {

/// The frame's vectors in their order, without the triangles that cover no pixel of the tile. Triangles are
/// never cut, so each pixel of the tile gets the same fragments as in the whole frame. Pixels outside the
/// tile get only some of their fragments and must not be used. A strip of object processors is included as a
/// whole.
/// The host's work for a unit is counted in one tile only, in which the unit's reach starts. The sum over the
/// tiles therefore equals the frame's count, for any size of tiles.
class TileSetup final : public Setup {
 public:
  /// `golden` is for the frame's hardware. `frame` must outlive this object.
  TileSetup(const Setup& frame, std::unique_ptr<GoldenModel> golden, const Tile& tile);

  unsigned init_bits() const override { return frame_.init_bits(); }
  std::uint32_t units() const override { return static_cast<std::uint32_t>(units_.size()); }
  bool units_are_strips() const override { return frame_.units_are_strips(); }
  Tile reach(std::uint32_t unit) const override { return frame_.reach(units_[unit]); }
  void append_prologue(std::vector<std::uint32_t>& words, SetupCounts& counts) const override;
  std::unique_ptr<SetupWorker> worker() const override;
  std::vector<std::string> notes() const override { return frame_.notes(); }

 private:
  class Worker;
  bool is_counted(const Tile& reach) const { return tile_.holds(reach.x, reach.y); }

  const Setup& frame_;
  Tile tile_;
  std::unique_ptr<GoldenModel> golden_;  ///< finds the vectors of a triangle
  std::vector<std::uint32_t> units_;     ///< units of the frame that touch the tile or are counted in it
};

}  // namespace halfway

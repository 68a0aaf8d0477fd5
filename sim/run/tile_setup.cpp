// SPDX-License-Identifier: Apache-2.0
#include "sim/run/tile_setup.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace halfway {

TileSetup::TileSetup(const Setup& frame, std::unique_ptr<GoldenModel> golden, const Tile& tile)
    : frame_(frame), tile_(tile), golden_(std::move(golden)) {
  for (std::uint32_t unit = 0; unit < frame.units(); ++unit)
    if (const Tile reach = frame.reach(unit); is_counted(reach) || overlap(reach, tile))
      units_.push_back(unit);
}

void TileSetup::append_prologue(std::vector<std::uint32_t>& words, SetupCounts& counted) const {
  SetupCounts of_frame;
  frame_.append_prologue(words, of_frame);
  if (is_counted({})) counted += of_frame;
}

void TileSetup::append(std::uint32_t unit, std::vector<std::uint32_t>& words, SetupCounts& counted) const {
  const Tile reach = this->reach(unit);
  std::vector<std::uint32_t> all;
  SetupCounts of_unit;
  frame_.append(units_[unit], all, of_unit);
  if (is_counted(reach))
    counted += of_unit;
  else  // every tile needs this value
    counted.deepest_shadow = std::max(counted.deepest_shadow, of_unit.deepest_shadow);
  const std::size_t words_per_vector = (init_bits() + 31) / 32;
  for (std::span<const std::uint32_t> rest = all; !rest.empty();) {
    const auto triangle = rest.first(golden_->group(rest) * words_per_vector);
    if (golden_->touches(triangle, tile_)) words.insert(words.end(), triangle.begin(), triangle.end());
    rest = rest.subspan(triangle.size());
  }
}

}  // namespace halfway

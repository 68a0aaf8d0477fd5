// SPDX-License-Identifier: Apache-2.0
#include "sim/driver/tile_setup.hpp"

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

class TileSetup::Worker final : public SetupWorker {
 public:
  explicit Worker(const TileSetup& setup) : setup_(setup), frame_(setup.frame_.worker()) {}

  void append(std::uint32_t unit, std::vector<std::uint32_t>& words, SetupCounts& counted) override {
    all_.clear();
    SetupCounts of_unit;
    frame_->append(setup_.units_[unit], all_, of_unit);
    if (setup_.is_counted(setup_.reach(unit))) counted += of_unit;
    const std::size_t words_per_vector = (setup_.init_bits() + 31) / 32;
    for (std::span<const std::uint32_t> rest = all_; !rest.empty();) {
      const auto triangle = rest.first(setup_.golden_->group(rest) * words_per_vector);
      if (setup_.golden_->touches(triangle, setup_.tile_))
        words.insert(words.end(), triangle.begin(), triangle.end());
      rest = rest.subspan(triangle.size());
    }
  }

 private:
  const TileSetup& setup_;
  std::unique_ptr<SetupWorker> frame_;
  std::vector<std::uint32_t> all_;  // the unit's vectors for the whole frame
};

std::unique_ptr<SetupWorker> TileSetup::worker() const {
  return std::make_unique<Worker>(*this);
}

}  // namespace halfway

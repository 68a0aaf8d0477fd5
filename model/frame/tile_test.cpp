// SPDX-License-Identifier: Apache-2.0
#include "frame/tile.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace halfway {
namespace {

TEST(Tiles, CoverEachPixelOnce) {
  const std::vector<std::pair<FrameSize, FrameSize>> cases = {{{64, 48}, {20, 20}},
                                                              {{64, 48}, {64, 48}},
                                                              {{64, 48}, {100, 7}},
                                                              {{1, 1}, {16, 16}},
                                                              {{33, 17}, {16, 16}}};
  for (const auto& [frame, tile] : cases) {
    std::vector<int> times(Frame::pixels(frame));
    for (const Tile& t : tiles_of(frame, tile)) {
      EXPECT_TRUE(overlap(t, whole_frame(frame)));
      for (std::uint32_t y = 0; y < frame.height; ++y)
        for (std::uint32_t x = 0; x < frame.width; ++x) times[y * frame.width + x] += t.holds(x, y);
    }
    EXPECT_EQ(times, std::vector<int>(times.size(), 1)) << to_string(frame) << " in " << to_string(tile);
  }
  EXPECT_EQ(tiles_of({64, 48}, {20, 20}).size(), 12U);
}

TEST(Tiles, OverlapWhereTheyShareAPixel) {
  const Tile tile{20, 10, {5, 5}};
  EXPECT_TRUE(overlap(tile, {24, 14, {9, 9}}));
  EXPECT_TRUE(overlap(tile, {0, 0, {21, 11}}));
  EXPECT_FALSE(overlap(tile, {25, 10, {5, 5}}));
  EXPECT_FALSE(overlap(tile, {20, 15, {5, 5}}));
  EXPECT_FALSE(overlap(tile, {0, 0, {20, 100}}));
  EXPECT_FALSE(overlap(tile, {22, 12, {0, 0}}));
}

TEST(Tiles, AssembleToTheFrame) {
  constexpr FrameSize c_frame{7, 5};
  Frame frame(c_frame);
  for (std::size_t i = 0; i < frame.rgb.size(); ++i) frame.rgb[i] = static_cast<std::uint8_t>(i);
  Frame again(c_frame);
  for (const Tile& tile : tiles_of(c_frame, {3, 2})) {
    Frame part(tile.size);
    for (std::uint32_t y = 0; y < tile.size.height; ++y)
      for (std::uint32_t x = 0; x < tile.size.width; ++x)
        for (std::size_t k = 0; k < 3; ++k)
          part.rgb[part.offset(x, y) + k] = frame.rgb[frame.offset(tile.x + x, tile.y + y) + k];
    EXPECT_EQ(cut_tile(frame, tile).rgb, part.rgb);
    put_tile(again, part, tile);
  }
  EXPECT_EQ(again.rgb, frame.rgb);
}

}  // namespace
}  // namespace halfway

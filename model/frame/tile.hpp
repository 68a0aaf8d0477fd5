// SPDX-License-Identifier: Apache-2.0
// Divides a frame into rectangles (tiles), and assembles the frame from them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "frame/frame.hpp"

namespace halfway {

/// Pixels [x, x + width) of lines [y, y + height) of a frame.
struct Tile {
  std::uint32_t x = 0, y = 0;
  FrameSize size;

  bool empty() const { return size.width == 0 || size.height == 0; }
  bool holds(std::uint32_t column, std::uint32_t line) const {
    return column - x < size.width && line - y < size.height;  // smaller coordinates wrap to large values
  }
  friend bool operator==(const Tile&, const Tile&) = default;
};

inline Tile whole_frame(FrameSize frame) {
  return {0, 0, frame};
}

inline bool overlap(const Tile& a, const Tile& b) {
  return !a.empty() && !b.empty() && a.x < b.x + b.size.width && b.x < a.x + a.size.width &&
         a.y < b.y + b.size.height && b.y < a.y + a.size.height;
}

/// Tiles of this size, line by line. Those at the right and at the bottom may be smaller. Each pixel lies in
/// exactly one tile.
inline std::vector<Tile> tiles_of(FrameSize frame, FrameSize tile) {
  std::vector<Tile> tiles;
  for (std::uint32_t y = 0; y < frame.height; y += tile.height)
    for (std::uint32_t x = 0; x < frame.width; x += tile.width)
      tiles.push_back(
          {x, y, {std::min(tile.width, frame.width - x), std::min(tile.height, frame.height - y)}});
  return tiles;
}

/// The tile's part of the frame.
inline Frame cut_tile(const Frame& frame, const Tile& tile) {
  Frame picture(tile.size);
  for (std::uint32_t y = 0; y < tile.size.height; ++y)
    std::copy_n(frame.rgb.begin() + static_cast<std::ptrdiff_t>(frame.offset(tile.x, tile.y + y)),
                3 * std::size_t{tile.size.width},
                picture.rgb.begin() + static_cast<std::ptrdiff_t>(picture.offset(0, y)));
  return picture;
}

/// Copies a tile's picture, of the tile's size, to its place in the frame.
inline void put_tile(Frame& frame, const Frame& picture, const Tile& tile) {
  for (std::uint32_t y = 0; y < tile.size.height; ++y)
    std::copy_n(picture.rgb.begin() + static_cast<std::ptrdiff_t>(picture.offset(0, y)),
                3 * std::size_t{tile.size.width},
                frame.rgb.begin() + static_cast<std::ptrdiff_t>(frame.offset(tile.x, tile.y + y)));
}

}  // namespace halfway

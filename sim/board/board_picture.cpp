// SPDX-License-Identifier: Apache-2.0
#include "sim/board/board_picture.hpp"

#include <algorithm>

namespace halfway::board {
namespace {

constexpr std::uint16_t c_farthest = 0xffff;

/// The upper five bits of a colour as three bits of one of the pixel's four dots. The dots get brighter in
/// the order (y, x) = (0, 0), (1, 1), (0, 1).
std::uint8_t level(unsigned five_bits, std::size_t y, std::size_t x) {
  constexpr unsigned c_brighter_from[2][2] = {{1, 3}, {4, 2}};
  const unsigned brighter = five_bits % 4 >= c_brighter_from[y % 2][x % 2] ? 1 : 0;
  return static_cast<std::uint8_t>(std::min(7U, five_bits / 4 + brighter));
}

}  // namespace

std::uint16_t rgb565(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  return static_cast<std::uint16_t>(red / 8 << 11 | green / 4 << 5 | blue / 8);
}

std::uint16_t rgb565(const glm::dvec3& radiance) {
  return rgb565(to_byte(radiance.r), to_byte(radiance.g), to_byte(radiance.b));
}

BoardPicture::BoardPicture(std::uint16_t background)
    : colours_(Frame::pixels(c_board_frame), background), depths_(colours_.size(), c_farthest) {}

void BoardPicture::add(std::span<const Fragment> fragments) {
  for (const Fragment& f : fragments) {
    const std::size_t at = std::size_t{f.y} * c_board_frame.width + f.x;
    const auto depth = static_cast<std::uint16_t>(f.z >> 8);
    if (depth >= depths_[at]) continue;
    depths_[at] = depth;
    colours_[at] = rgb565(f.red, f.green, f.blue);
  }
}

DotPicture BoardPicture::dots() const {
  DotPicture dots(Frame::pixels(c_monitor));
  for (std::size_t y = 0; y < c_monitor.height; ++y)
    for (std::size_t x = 0; x < c_monitor.width; ++x) {
      const unsigned colour = colours_[y / 2 * c_board_frame.width + x / 2];
      dots[y * c_monitor.width + x] = {level(colour >> 11, y, x), level(colour >> 6 & 31, y, x),
                                       level(colour & 31, y, x)};
    }
  return dots;
}

}  // namespace halfway::board

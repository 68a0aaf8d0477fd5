// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/board/board_pkg.vhd and of the conversions in rtl/board/fragment_pixel.vhd: the pixels
// of the board's memory and the bits at the monitor's pins.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "frame/fragment.hpp"

namespace halfway::golden {

inline constexpr std::uint32_t c_board_width = 320, c_board_height = 240;
inline constexpr std::uint32_t c_board_pixels = c_board_width * c_board_height;
inline constexpr std::uint16_t c_board_farthest = 0xffff;  ///< depth of a pixel without a fragment

/// Place of the fragment's pixel in each buffer; empty if it is outside the frame.
constexpr std::optional<std::uint32_t> board_place(const Fragment& fragment) {
  if (fragment.x >= c_board_width || fragment.y >= c_board_height) return std::nullopt;
  return fragment.y * c_board_width + fragment.x;
}

/// Depth in memory: the upper 16 of 24 bits. A fragment is drawn if its depth is less than the stored one.
constexpr std::uint16_t board_depth(std::uint32_t z) {
  return static_cast<std::uint16_t>(z >> 8);
}

/// Colour in memory, RGB565: the upper bits of each colour.
constexpr std::uint16_t board_colour(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  return static_cast<std::uint16_t>((red >> 3) << 11 | (green >> 2) << 5 | blue >> 3);
}

/// Levels 0 to 7 of red, green and blue at the pins.
using BoardLevels = std::array<std::uint8_t, 3>;

/// The bits at the pins for dot (x, y) of the monitor, 640x480, which shows a pixel of this colour as 2x2
/// dots. The lower two of a colour's upper five bits are the number of its four dots that get the next
/// brighter level. Levels above 7 are 7.
constexpr BoardLevels board_pins(std::uint16_t colour, unsigned x, unsigned y) {
  // Dots get brighter in the order (y, x) = (0, 0), (1, 1), (0, 1).
  constexpr unsigned c_least[2][2] = {{1, 3}, {4, 2}};
  const unsigned least = c_least[y % 2][x % 2];
  const auto level = [least](unsigned five_bits) {
    const unsigned dithered = (five_bits >> 2) + ((five_bits & 3) >= least ? 1 : 0);
    return static_cast<std::uint8_t>(dithered > 7 ? 7 : dithered);
  };
  return {level(colour >> 11), level(colour >> 6 & 31), level(colour & 31)};
}

}  // namespace halfway::golden

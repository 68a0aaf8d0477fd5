// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/board/board_picture.hpp"

#include <optional>

#include "golden/board_pixel.hpp"

namespace halfway::board {

std::uint16_t rgb565(const glm::dvec3& radiance) {
  return golden::board_colour(to_byte(radiance.r), to_byte(radiance.g), to_byte(radiance.b));
}

BoardPicture::BoardPicture(std::uint16_t background)
    : colours_(golden::c_board_pixels, background),
      depths_(golden::c_board_pixels, golden::c_board_farthest),
      exact_colours_(colours_),
      exact_depths_(golden::c_board_pixels, UINT32_MAX) {}

void BoardPicture::add(std::span<const Fragment> fragments) {
  for (const Fragment& f : fragments) {
    const std::optional<std::uint32_t> at = golden::board_place(f);
    if (!at) continue;
    const auto draw = [&](auto depth, auto& nearest, std::uint16_t& colour) {
      if (depth >= nearest) return;
      nearest = depth;
      colour = golden::board_colour(f.red, f.green, f.blue);
    };
    draw(golden::board_depth(f.z), depths_[*at], colours_[*at]);
    draw(f.z, exact_depths_[*at], exact_colours_[*at]);
  }
}

std::uint64_t BoardPicture::depth_pixels() const {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < colours_.size(); ++i) count += colours_[i] != exact_colours_[i] ? 1 : 0;
  return count;
}

DotPicture BoardPicture::dots() const {
  DotPicture dots;
  dots.reserve(Frame::pixels(c_monitor));
  for (unsigned y = 0; y < c_monitor.height; ++y)
    for (unsigned x = 0; x < c_monitor.width; ++x)
      dots.push_back(golden::board_pins(colours_[y / 2 * golden::c_board_width + x / 2], x, y));
  return dots;
}

}  // namespace halfway::board

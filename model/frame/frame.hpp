// SPDX-License-Identifier: Apache-2.0
// A picture with 8 bits per channel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/to_integer.hpp"
#include "frame/frame_size.hpp"

namespace halfway {

/// Greatest width and height of a frame.
inline constexpr std::uint32_t c_max_frame_side = 4096;

struct Frame {
  FrameSize size;
  std::vector<std::uint8_t> rgb;  ///< red, green, blue of each pixel, line by line from the top left

  Frame() = default;
  /// A black frame.
  explicit Frame(FrameSize frame_size) : size(frame_size), rgb(3 * pixels(frame_size)) {}

  static std::size_t pixels(FrameSize s) { return std::size_t{s.width} * s.height; }
  std::size_t pixels() const { return pixels(size); }
  std::size_t offset(std::uint32_t x, std::uint32_t y) const { return 3 * (std::size_t{y} * size.width + x); }
};

/// Converts linear radiance to a channel: round(255 clamp(v, 0, 1)), halves up. NaN gives 0.
constexpr std::uint8_t to_byte(double v) {
  return v >= 1 ? std::uint8_t{255} : v > 0 ? to_integer<std::uint8_t>(255 * v + 0.5) : std::uint8_t{0};
}

}  // namespace halfway

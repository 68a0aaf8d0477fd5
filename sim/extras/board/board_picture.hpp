// SPDX-License-Identifier: Apache-2.0
// The twin of the board: fragments to colours of RGB565 by a depth test of 16 bits, and these to the dots on
// the monitor.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "frame/fragment.hpp"
#include "frame/frame.hpp"
#include "golden/board_pixel.hpp"
#include "sim/extras/board/board_models.hpp"

namespace halfway::board {

inline constexpr FrameSize c_board_frame{golden::c_board_width, golden::c_board_height};
/// Two buffers of colours and one of depths.
inline constexpr std::uint32_t c_words_in_use = 3 * golden::c_board_pixels;

/// Linear radiance in the board's memory.
std::uint16_t rgb565(const glm::dvec3& radiance);

class BoardPicture {
 public:
  explicit BoardPicture(std::uint16_t background);

  /// The fragment with the smallest depth is kept; of equal depths the first.
  void add(std::span<const Fragment> fragments);

  /// Each pixel is 2x2 dots.
  DotPicture dots() const;
  const std::vector<std::uint16_t>& colours() const { return colours_; }
  /// Pixels in which 16 bits of depth choose another fragment than 24 bits, with another colour.
  std::uint64_t depth_pixels() const;

 private:
  std::vector<std::uint16_t> colours_, depths_;
  std::vector<std::uint16_t> exact_colours_;  ///< with 24 bits of depth
  std::vector<std::uint32_t> exact_depths_;
};

}  // namespace halfway::board

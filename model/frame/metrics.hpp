// SPDX-License-Identifier: Apache-2.0
// Metrics of the difference between two frames.
#pragma once

#include <cstdint>
#include <span>

#include "common/result.hpp"
#include "frame/frame.hpp"

namespace halfway {

/// Greatest difference of two pixels that count as close.
inline constexpr unsigned c_close = 2;

/// Over the three channels of the compared pixels, in steps of 1/255.
struct FrameDistance {
  std::uint64_t pixels = 0;     ///< compared
  std::uint64_t differing = 0;  ///< compared pixels with at least one differing channel
  std::uint64_t off = 0;        ///< compared pixels with a channel that differs by more than c_close steps
  double psnr_db = 0.0;         ///< 20 log10(255/rms), infinity if nothing differs
  double rms = 0.0;
  unsigned max_lsb = 0;       ///< greatest absolute difference
  unsigned percentile99 = 0;  ///< least d such that at least 99 % of the channels differ by d or less
};

/// Compares the pixels whose mask byte is not 0. An empty mask selects all pixels. The sizes must be equal.
Result<FrameDistance> frame_distance(const Frame& a, const Frame& b, std::span<const std::uint8_t> mask = {});

/// Scale of the difference image: one step of difference gives this many steps. 8 or more steps give white.
inline constexpr unsigned c_difference_scale = 32;

/// Absolute difference per channel times c_difference_scale, at most 255. Black means equal.
Result<Frame> difference_image(const Frame& a, const Frame& b);

}  // namespace halfway

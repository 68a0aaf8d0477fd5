// SPDX-License-Identifier: Apache-2.0
// How far one frame is from another.
#pragma once

#include <cstdint>
#include <span>

#include "common/result.hpp"
#include "frame/frame.hpp"

namespace halfway {

/// As far apart pixels may be that show the same.
inline constexpr unsigned c_close = 2;

/// Over the three channels of the pixels compared, in steps of 1/255.
struct FrameDistance {
  std::uint64_t pixels = 0;     ///< compared
  std::uint64_t differing = 0;  ///< of them, with at least one channel that differs
  std::uint64_t off = 0;        ///< of them, with one that differs by more than c_close steps
  double psnr_db = 0.0;         ///< 20 log10(255/rms), infinity where nothing differs
  double rms = 0.0;
  unsigned max_lsb = 0;       ///< greatest absolute difference
  unsigned percentile99 = 0;  ///< least d such that 99 of 100 channels differ by d or less
};

/// Compares the pixels whose mask byte is not 0; an empty mask means all. Sizes must agree.
Result<FrameDistance> frame_distance(const Frame& a, const Frame& b, std::span<const std::uint8_t> mask = {});

/// One step of difference is this many steps in the difference image; from 8 steps on it is white.
inline constexpr unsigned c_difference_scale = 32;

/// Absolute difference a channel times c_difference_scale, at most 255. Black is equal.
Result<Frame> difference_image(const Frame& a, const Frame& b);

}  // namespace halfway

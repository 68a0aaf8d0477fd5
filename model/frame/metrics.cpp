// SPDX-License-Identifier: Apache-2.0
#include "frame/metrics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace halfway {
namespace {

Status same_size(const Frame& a, const Frame& b) {
  if (a.size.width != b.size.width || a.size.height != b.size.height)
    return bad_input(fmt::format("frames: {}x{} and {}x{} cannot be compared; render both at one size",
                                 a.size.width, a.size.height, b.size.width, b.size.height));
  if (a.rgb.size() != 3 * a.pixels() || b.rgb.size() != 3 * b.pixels())
    return bad_input("frames: a frame does not have three bytes per pixel; render it again");
  return Ok{};
}

unsigned distance(std::uint8_t a, std::uint8_t b) {
  return static_cast<unsigned>(std::abs(int{a} - int{b}));
}

}  // namespace

Result<FrameDistance> frame_distance(const Frame& a, const Frame& b, std::span<const std::uint8_t> mask) {
  if (const Status status = same_size(a, b); !status) return status.error();
  if (!mask.empty() && mask.size() != a.pixels())
    return bad_input(
        fmt::format("frames: a mask of {} pixels for a frame of {}; render the mask with the frame",
                    mask.size(), a.pixels()));

  FrameDistance result;
  std::array<std::uint64_t, 256> channels_by_distance{};
  for (std::size_t i = 0; i < a.pixels(); ++i) {
    if (!mask.empty() && mask[i] == 0) continue;
    ++result.pixels;
    unsigned worst = 0;
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
      const unsigned d = distance(a.rgb[k], b.rgb[k]);
      ++channels_by_distance[d];
      worst = std::max(worst, d);
    }
    result.differing += worst > 0;
    result.off += worst > c_close;
  }

  const std::uint64_t channels = 3 * result.pixels;
  std::uint64_t sum_of_squares = 0, seen = 0;  // at most 3 * 2^24 channels of 2^16 each: fits 64 bits
  bool percentile_found = false;
  for (unsigned d = 0; d < 256; ++d) {
    const std::uint64_t count = channels_by_distance[d];
    sum_of_squares += count * d * d;
    if (count > 0) result.max_lsb = d;
    seen += count;
    if (!percentile_found && 100 * seen >= 99 * channels) result.percentile99 = d, percentile_found = true;
  }
  if (sum_of_squares == 0) {
    result.psnr_db = std::numeric_limits<double>::infinity();
    return result;
  }
  result.rms = std::sqrt(static_cast<double>(sum_of_squares) / static_cast<double>(channels));
  result.psnr_db = 20.0 * std::log10(255.0 / result.rms);
  return result;
}

Result<Frame> difference_image(const Frame& a, const Frame& b) {
  if (const Status status = same_size(a, b); !status) return status.error();
  Frame image(a.size);
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    image.rgb[i] =
        static_cast<std::uint8_t>(std::min(255u, c_difference_scale * distance(a.rgb[i], b.rgb[i])));
  return image;
}

}  // namespace halfway

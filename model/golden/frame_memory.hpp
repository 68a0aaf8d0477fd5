// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/memory: a picture and a depth buffer as bytes in memory, little-endian.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "frame/fragment.hpp"
#include "golden/board_pixel.hpp"

namespace halfway::golden {

enum class PixelFormat {
  rgb565,   ///< and a depth of 16 bits: the upper bits of a fragment's depth
  xrgb8888  ///< and a depth of 32 bits: the upper 8 are 0, but for a pixel that is cleared
};

inline const char* to_string(PixelFormat format) {
  return format == PixelFormat::rgb565 ? "rgb565" : "xrgb8888";
}

/// The parameters of a frame, as frame_t of memory_pkg.vhd. Addresses and strides are in bytes.
struct FramePlace {
  std::uint32_t colour_base = 0, colour_stride = 0, depth_base = 0, depth_stride = 0;
  std::uint32_t width = 0, height = 0;
  std::uint32_t left = 0, right = 0, top = 0, bottom = 0;  ///< scissor: [left, right) x [top, bottom)

  bool holds(std::uint32_t x, std::uint32_t y) const {
    return x < width && y < height && x >= left && x < right && y >= top && y < bottom;
  }
};

constexpr std::uint32_t pixel_bytes(PixelFormat format) {
  return format == PixelFormat::rgb565 ? 2 : 4;
}
constexpr std::uint32_t depth_word(PixelFormat format, std::uint32_t z) {
  return format == PixelFormat::rgb565 ? board_depth(z) : z;
}
constexpr std::uint32_t colour_word(PixelFormat format, std::uint8_t red, std::uint8_t green,
                                    std::uint8_t blue) {
  return format == PixelFormat::rgb565 ? std::uint32_t{board_colour(red, green, blue)}
                                       : std::uint32_t{red} << 16 | green << 8 | blue;
}

class FrameMemory {
 public:
  /// `bytes` has the addresses from `origin` on.
  FrameMemory(PixelFormat format, std::span<std::uint8_t> bytes, std::uint32_t origin)
      : format_(format), bytes_(bytes), origin_(origin) {}

  /// Writes the colour and the farthest depth, all bits 1, to each pixel of the frame inside the scissor.
  void clear(const FramePlace& place, std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
    for (std::uint32_t y = place.top; y < place.bottom && y < place.height; ++y)
      for (std::uint32_t x = place.left; x < place.right && x < place.width; ++x) {
        put(depth_at(place, x, y), ~std::uint32_t{0});
        put(colour_at(place, x, y), colour_word(format_, red, green, blue));
      }
  }

  /// Drops a fragment outside frame or scissor. Keeps another one if its depth, as a word of the format, is
  /// less than the stored one: of equal words the first stays. FrameAssembler has the same rule with 24 bits,
  /// so XRGB8888 gives its frame. With 16 bits, depths that differ in the lower 8 bits are equal, and a
  /// fragment of the farthest 256 depths is not drawn on a cleared pixel. True: the fragment is kept.
  bool draw(const FramePlace& place, const Fragment& fragment) {
    if (!place.holds(fragment.x, fragment.y)) return false;
    const std::size_t depth = depth_at(place, fragment.x, fragment.y);
    const std::uint32_t word = depth_word(format_, fragment.z);
    if (word >= get(depth)) return false;
    put(depth, word);
    put(colour_at(place, fragment.x, fragment.y),
        colour_word(format_, fragment.red, fragment.green, fragment.blue));
    return true;
  }

 private:
  std::size_t depth_at(const FramePlace& p, std::uint32_t x, std::uint32_t y) const {
    return p.depth_base + y * p.depth_stride + x * pixel_bytes(format_) - origin_;
  }
  std::size_t colour_at(const FramePlace& p, std::uint32_t x, std::uint32_t y) const {
    return p.colour_base + y * p.colour_stride + x * pixel_bytes(format_) - origin_;
  }
  std::uint32_t get(std::size_t at) const {
    std::uint32_t word = 0;
    for (std::uint32_t i = 0; i < pixel_bytes(format_); ++i) word |= std::uint32_t{bytes_[at + i]} << (8 * i);
    return word;
  }
  void put(std::size_t at, std::uint32_t word) {
    for (std::uint32_t i = 0; i < pixel_bytes(format_); ++i)
      bytes_[at + i] = static_cast<std::uint8_t>(word >> (8 * i));
  }

  PixelFormat format_;
  std::span<std::uint8_t> bytes_;
  std::uint32_t origin_;
};

}  // namespace halfway::golden

// SPDX-License-Identifier: Apache-2.0
// Cuts a frame into strips for a chain of object processors (rtl/objects/object_source.vhd): each processor
// holds one walk, from its first to its last line of pixels, so no line of a strip may need more walks than
// there are processors.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "frame/tile.hpp"
#include "projection/screen_triangle.hpp"
#include "setup/walk.hpp"

namespace halfway {

/// The chain, and what it can scan at once.
struct ObjectChain {
  std::uint32_t processors;
  std::uint32_t side = 1;  ///< subpixels per row of a pixel: 1, 2 or 4
  std::uint32_t most_columns = 4096, most_lines = 4096;
  /// Pixels are filtered over 2x2. A strip then also scans the column to the left of its pixels and the line
  /// above them, and draws the pixels right of an object and below it.
  bool filtered() const { return side > 1; }
};

/// `points`: the corners of a triangle or shadow polygon, in 1/2^unit_bits pixels.
using StripItem = std::array<ScreenPoint, 3>;

struct ObjectStrip {
  Tile area;                                    ///< what is scanned
  std::vector<std::uint32_t> objects, shadows;  ///< that have a walk in it, in their order
};

struct ObjectStrips {
  std::vector<ObjectStrip> strips;
  /// The greatest number of walks on one line of a strip. Above the number of processors if even a strip of
  /// one column, or two with the filter, needs more.
  std::uint32_t processors = 0;
};

/// Strips that together draw every pixel that an object covers, each pixel once. A strip is halved until its
/// lines fit the processors. Lines and columns without an object are left out: shadow polygons draw nothing.
ObjectStrips cut_strips(std::span<const StripItem> objects, std::span<const StripItem> shadows, int unit_bits,
                        FrameSize frame, const ObjectChain& chain);

/// The walks of an item in a strip, in subpixels from its first pixel. They may leave its columns on both
/// sides. One walk, unless the item reaches 4095 subpixels less half the strip's width beyond it.
Walks strip_walks(const StripItem& item, int unit_bits, const Tile& area, std::uint32_t side);

/// The lines of pixels of such a walk, from the strip's first: [begin, end).
struct PixelLines {
  std::int64_t begin, end;
};
inline PixelLines pixel_lines(const Walk& walk, std::uint32_t side) {
  return {walk.y / side, (walk.y + walk.upper_lines + walk.lower_lines - 1) / side + 1};
}

}  // namespace halfway

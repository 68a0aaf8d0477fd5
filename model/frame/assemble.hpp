// SPDX-License-Identifier: Apache-2.0
// From a stream of fragments to a frame: z test and write, the same for golden model and simulators.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "common/result.hpp"
#include "frame/fragment.hpp"
#include "frame/frame.hpp"
#include "frame/tile.hpp"

namespace halfway {

class FrameAssembler {
 public:
  /// `background` is linear radiance, for pixels without a fragment.
  FrameAssembler(FrameSize size, glm::dvec3 background)
      : FrameAssembler(size, whole_frame(size), background) {}
  /// Of a frame of this size the tile alone: what falls beside it is left out.
  FrameAssembler(FrameSize size, const Tile& tile, glm::dvec3 background);

  /// Begins another frame, in the same room: new room would be the system's to find and to clear, page by
  /// page.
  void clear();

  /// The smaller z keeps a pixel; of equal ones the first to come. Fails at the first fragment that lies
  /// outside the frame or whose z has more than 24 bits; those before it are in the frame.
  Status add(std::span<const Fragment> fragments);

  const Frame& frame() const { return frame_; }  ///< or the tile
  /// 1 where a fragment fell, else 0; one byte a pixel.
  std::vector<std::uint8_t> mask() const;
  /// Depth of each pixel; none without a fragment.
  std::optional<std::uint32_t> depth(std::uint32_t x, std::uint32_t y) const;
  std::uint64_t fragments() const { return fragments_; }
  std::uint64_t fragments_inside() const { return fragments_ - beside_; }  ///< the tile
  std::uint64_t covered_pixels() const { return covered_pixels_; }

 private:
  FrameSize size_;
  Tile tile_;
  std::array<std::uint8_t, 3> background_;
  Frame frame_;
  std::vector<std::uint32_t> z_;
  std::uint64_t fragments_ = 0, beside_ = 0, covered_pixels_ = 0;
};

}  // namespace halfway

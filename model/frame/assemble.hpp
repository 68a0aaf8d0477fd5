// SPDX-License-Identifier: Apache-2.0
// Assembles a frame from a stream of fragments: z test and write. Golden model and simulators use the same
// code.
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
  /// Assembles one tile of a frame of this size. Fragments outside the tile are counted and discarded.
  FrameAssembler(FrameSize size, const Tile& tile, glm::dvec3 background);

  /// Starts another frame in the same memory. New memory would have to be allocated and cleared by the
  /// operating system page by page.
  void clear();

  /// The fragment with the smallest z is kept; of equal z the first. Fails at the first fragment that lies
  /// outside the frame or whose z has more than 24 bits. The fragments before it are in the frame.
  Status add(std::span<const Fragment> fragments);

  const Frame& frame() const { return frame_; }  ///< or of the tile
  /// One byte per pixel: 1 if the pixel has a fragment, else 0.
  std::vector<std::uint8_t> mask() const;
  /// Depth of a pixel; empty without a fragment.
  std::optional<std::uint32_t> depth(std::uint32_t x, std::uint32_t y) const;
  std::uint64_t fragments() const { return fragments_; }
  std::uint64_t fragments_inside() const { return fragments_ - outside_; }  ///< inside the tile
  std::uint64_t covered_pixels() const { return covered_pixels_; }

 private:
  FrameSize size_;
  Tile tile_;
  std::array<std::uint8_t, 3> background_;
  Frame frame_;
  std::vector<std::uint32_t> z_;
  std::uint64_t fragments_ = 0, outside_ = 0, covered_pixels_ = 0;
};

}  // namespace halfway

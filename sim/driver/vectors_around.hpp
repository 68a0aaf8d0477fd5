// SPDX-License-Identifier: Apache-2.0
// Selects the init vectors of a frame with which a simulator draws some triangles as in the whole frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "plan/hardware_key.hpp"

namespace halfway {

/// Keeps the vectors of the wanted triangles and of two triangles before and after each. For hardware with a
/// state from vector to vector it also keeps the vectors that define the state.
class VectorsAround {
 public:
  struct Triangle {
    std::uint64_t first;  ///< number of its first vector in the frame
    std::vector<std::uint32_t> words;
  };

  explicit VectorsAround(HardwareKey key) : key_(std::move(key)) {}

  /// Adds the next triangle of the frame, with `count` vectors.
  void add(std::span<const std::uint32_t> words, std::size_t count, bool wanted);
  /// Ends the frame. If no triangle was wanted, keeps the last ones.
  void finish();
  /// True if nothing more will be kept unless another triangle is wanted.
  bool complete() const { return any_wanted_ && after_ == 0; }
  /// The kept triangles in the frame's order.
  const std::vector<Triangle>& kept() const { return kept_; }
  /// The words of all kept triangles.
  std::vector<std::uint32_t> words() const;

 private:
  HardwareKey key_;
  std::vector<Triangle> kept_;
  std::deque<Triangle> before_;  // kept if a wanted one follows
  std::size_t after_ = 0;        // triangles still to be kept
  std::uint64_t next_ = 0;
  bool any_wanted_ = false;
};

}  // namespace halfway

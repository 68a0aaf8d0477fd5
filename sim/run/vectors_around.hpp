// SPDX-License-Identifier: Apache-2.0
// Of a frame's init vectors, those that a simulator must be given to draw some triangles as in the frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "plan/hardware_key.hpp"

namespace halfway {

/// Keeps the wanted triangles' vectors, those of two triangles before and after each, and of hardware that
/// keeps something from a vector to the next also what it was told once, and all of the line.
class VectorsAround {
 public:
  struct Triangle {
    std::uint64_t first;  ///< number of its first vector in the frame
    std::vector<std::uint32_t> words;
  };

  explicit VectorsAround(HardwareKey key) : key_(std::move(key)) {}

  /// The next triangle of the frame: its vectors, `count` of them.
  void add(std::span<const std::uint32_t> words, std::size_t count, bool wanted);
  /// No more will come. Keeps the last triangles where none was wanted.
  void finish();
  /// Nothing more is kept unless another triangle is wanted.
  bool complete() const { return any_wanted_ && after_ == 0; }
  /// In the frame's order.
  const std::vector<Triangle>& kept() const { return kept_; }
  /// All their words.
  std::vector<std::uint32_t> words() const;

 private:
  HardwareKey key_;
  std::vector<Triangle> kept_;
  std::deque<Triangle> before_;  // kept if a wanted one follows
  std::optional<std::uint64_t> line_;
  std::size_t after_ = 0;  // triangles still to be kept
  std::uint64_t next_ = 0;
  bool any_wanted_ = false;
};

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/objects/object_edges.vhd: the subpixels that a triangle covers, in raster order.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "golden/edge_pair.hpp"
#include "golden/line_counter.hpp"

namespace halfway::golden {

class ObjectEdges {
 public:
  explicit ObjectEdges(int side) : side_(static_cast<std::size_t>(side)) {}

  /// The next line is the one with the walk's first line.
  void load(std::span<const std::uint32_t> walk) {
    lines_.load(walk);
    edges_.load(walk);
    ended_ = false;
    collect(lines_.y() % side_);
  }
  /// The triangle has no more lines.
  void reset() {
    ended_ = true;
    more_ = false;
  }
  void line_step() {
    spans_ = next_;
    collect(0);
  }
  void pixel_step() {
    const Distance back = Distance::from_bits(~std::uint64_t{side_} + 1);
    for (std::size_t row = 0; row < side_; ++row) {
      spans_[row].left += back;
      spans_[row].right += back;
    }
  }

  /// True if the next line has a part of the triangle.
  bool more() const { return more_; }
  std::uint32_t mask() const {
    std::uint32_t mask = 0;
    for (std::size_t row = 0; row < side_; ++row)
      for (std::size_t column = 0; column < side_; ++column) {
        const auto x = static_cast<std::int64_t>(column);
        if (spans_[row].left.value() <= x && x < spans_[row].right.value())
          mask |= 1U << (side_ * row + column);
      }
    return mask;
  }

 private:
  using Distance = Word<Exact::c_span_x_bits + 2>;
  // [left, right), in subpixels from the pixel.
  struct Span {
    Distance left, right;
  };
  using Spans = std::array<Span, 4>;

  // The spans of the next line. The first `skip` rows are before the triangle's first line.
  void collect(std::size_t skip) {
    next_ = {};
    more_ = false;
    for (std::size_t row = skip; row < side_ && !ended_; ++row) {
      more_ = true;
      const std::int64_t start = edges_.start().value(), stop = edges_.stop().value();
      const auto distance = [](std::int64_t x) { return Distance::from_bits(static_cast<std::uint64_t>(x)); };
      next_[row] = edges_.backward() ? Span{distance(stop + 1), distance(start + 1)}
                                     : Span{distance(start), distance(stop)};
      ended_ = lines_.last();
      if (ended_) continue;
      edges_.step(lines_.section_last());
      lines_.step();
    }
  }

  std::size_t side_;
  LineCounter<Exact> lines_;
  EdgePair<Exact> edges_;
  bool ended_ = true;  ///< all lines are collected
  bool more_ = false;
  Spans next_{}, spans_{};
};

}  // namespace halfway::golden

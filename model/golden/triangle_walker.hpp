// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/raster/triangle_walker.vhd: the same lines and pixels in the same order, without
// timing.
#pragma once

#include "golden/edge_pair.hpp"
#include "golden/line_counter.hpp"

namespace halfway::golden {

template <class Preset>
class TriangleWalker {
 public:
  using At = typename Preset::init_header_at;

  void line_load(std::span<const std::uint32_t> init) {
    lines_.load(init);
    edges_.load(init);
  }

  std::uint32_t triangle() const { return lines_.triangle(); }
  std::uint32_t y() const { return lines_.y(); }
  bool backward() const { return edges_.backward(); }
  bool carry() const { return edges_.carry(); }
  /// First pixel of the line, and the pixel after its last.
  SpanXWord start() const { return edges_.start(); }
  SpanXWord stop() const { return edges_.stop(); }
  bool line_empty() const { return edges_.empty(); }
  bool line_last() const { return lines_.last(); }
  /// Number of pixels of the line. The line must not be empty.
  std::size_t pixels() const { return edges_.pixels(); }
  /// Step from a pixel of a span to the next one: 1 or -1.
  SpanXWord pixel_step() const {
    return SpanXWord::from_bits(backward() ? ~std::uint64_t{0} : std::uint64_t{1});
  }

  /// Calls line() for each line from the loaded one to the triangle's last.
  template <class Line>
  void walk(Line&& line) {
    for (;; line_step()) {
      line();
      if (line_last()) return;
    }
  }

  void line_step() {
    edges_.step(lines_.section_last());
    lines_.step();
  }

 private:
  LineCounter<Preset> lines_;
  EdgePair<Preset> edges_;
};

}  // namespace halfway::golden

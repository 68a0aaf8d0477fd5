// SPDX-License-Identifier: Apache-2.0
// Twin of rtl/raster/triangle_walker.vhd: the same lines and pixels in the same order, without the clock.
#pragma once

#include <type_traits>

#include "golden/edge_walker.hpp"
#include "golden/slope_walker.hpp"

namespace halfway::golden {

template <class Preset>
class TriangleWalker {
 public:
  using At = typename Preset::init_header_at;
  static constexpr bool c_exact = std::is_same_v<Preset, Exact>;

  void line_load(std::span<const std::uint32_t> init) {
    const auto word = [&](const Field& field) { return static_cast<std::uint32_t>(get_bits(init, field)); };
    triangle_ = word(At::triangle);
    y_ = word(At::y);
    lines_ = word(At::upper_lines);
    if constexpr (c_exact) {
      lower_lines_ = word(At::lower_lines);
      backward_ = word(At::backward) != 0;
      start_edge_.load({span_x(init, At::start_x), span_x(init, At::start_quotient),
                        word(At::start_remainder), word(At::start_divisor), word(At::start_error),
                        word(At::start_carry) != 0});
      stop_edge_.load({span_x(init, At::upper_x), span_x(init, At::upper_quotient), word(At::upper_remainder),
                       word(At::upper_divisor), word(At::upper_error), word(At::upper_carry) != 0});
      lower_ = {span_x(init, At::lower_x), span_x(init, At::lower_quotient),
                word(At::lower_remainder), word(At::lower_divisor),
                word(At::lower_error),     word(At::lower_carry) != 0};
    } else {
      start_edge_.load(edge_x(init, At::start_x), edge_x(init, At::start_slope));
      stop_edge_.load(edge_x(init, At::upper_x), edge_x(init, At::upper_slope));
    }
  }

  std::uint32_t triangle() const { return triangle_; }
  std::uint32_t y() const { return y_; }
  bool backward() const { return backward_; }
  bool carry() const {
    if constexpr (c_exact)
      return start_edge_.carry();
    else
      return false;
  }
  /// First pixel of the line, and the one after its last.
  SpanXWord start() const { return start_edge_.x(); }
  SpanXWord stop() const {
    if constexpr (c_exact)
      return stop_edge_.x();
    else
      return stop_edge_.x() + SpanXWord::from_bits(1);
  }
  bool line_empty() const {
    return backward_ ? start().value() <= stop().value() : start().value() >= stop().value();
  }
  bool line_last() const { return lines_ == 1 && lower_lines_ == 0; }
  /// Of the line, where it is not empty.
  std::size_t pixels() const {
    const std::int64_t from = start().value(), to = stop().value();
    return static_cast<std::size_t>(backward_ ? from - to : to - from);
  }
  /// From a pixel of a span to the next one: 1 or -1.
  SpanXWord pixel_step() const {
    return SpanXWord::from_bits(backward_ ? ~std::uint64_t{0} : std::uint64_t{1});
  }

  /// Calls line() at each line from the loaded one to the triangle's last.
  template <class Line>
  void walk(Line&& line) {
    for (;; line_step()) {
      line();
      if (line_last()) return;
    }
  }

  void line_step() {
    const bool to_lower = lines_ == 1 && lower_lines_ != 0;
    if constexpr (c_exact) {
      start_edge_.step();
      if (to_lower)
        stop_edge_.load(lower_);
      else
        stop_edge_.step();
    } else {
      start_edge_.step();
      stop_edge_.step();
    }
    y_ = static_cast<std::uint32_t>(low_bits(y_ + 1, Preset::c_pixel_y_bits));
    lines_ = static_cast<std::uint32_t>(low_bits(lines_ - 1, Preset::c_lines_bits));
    if (to_lower) {
      lines_ = lower_lines_;
      lower_lines_ = 0;
    }
  }

 private:
  using StepEdge = std::conditional_t<c_exact, EdgeWalker, SlopeWalker>;

  static SpanXWord span_x(std::span<const std::uint32_t> init, const Field& field) {
    return SpanXWord::from_bits(get_bits(init, field));
  }
  static SlopeWalker::EdgeX edge_x(std::span<const std::uint32_t> init, const Field& field) {
    return SlopeWalker::EdgeX::from_bits(get_bits(init, field));
  }

  std::uint32_t triangle_ = 0, y_ = 0, lines_ = 0, lower_lines_ = 0;
  bool backward_ = false;
  StepEdge start_edge_, stop_edge_;
  EdgeStart lower_;
};

}  // namespace halfway::golden

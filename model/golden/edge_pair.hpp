// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/raster/edge_pair.vhd.
#pragma once

#include <type_traits>

#include "golden/edge_walker.hpp"
#include "golden/slope_walker.hpp"

namespace halfway::golden {

/// Both edges of a triangle at one line.
template <class Preset>
class EdgePair {
 public:
  using At = typename Preset::init_header_at;
  static constexpr bool c_exact = std::is_same_v<Preset, Exact>;

  void load(std::span<const std::uint32_t> init) {
    if constexpr (c_exact) {
      const auto word = [&](const Field& field) { return static_cast<std::uint32_t>(get_bits(init, field)); };
      start_edge_.load({span_x(init, At::start_x), span_x(init, At::start_quotient),
                        word(At::start_remainder), word(At::start_divisor), word(At::start_error),
                        word(At::start_carry) != 0});
      stop_edge_.load({span_x(init, At::upper_x), span_x(init, At::upper_quotient), word(At::upper_remainder),
                       word(At::upper_divisor), word(At::upper_error), word(At::upper_carry) != 0});
      lower_ = {span_x(init, At::lower_x), span_x(init, At::lower_quotient),
                word(At::lower_remainder), word(At::lower_divisor),
                word(At::lower_error),     word(At::lower_carry) != 0};
      backward_ = word(At::backward) != 0;
    } else {
      start_edge_.load(edge_x(init, At::start_x), edge_x(init, At::start_slope));
      stop_edge_.load(edge_x(init, At::upper_x), edge_x(init, At::upper_slope));
    }
  }
  /// Advances to the next line. With `section_change` the stop edge continues with its lower section.
  void step(bool section_change) {
    start_edge_.step();
    if constexpr (c_exact) {
      if (section_change) {
        stop_edge_.load(lower_);
        return;
      }
    }
    stop_edge_.step();
  }

  /// First pixel of the line, and the pixel after its last.
  SpanXWord start() const { return start_edge_.x(); }
  SpanXWord stop() const {
    if constexpr (c_exact)
      return stop_edge_.x();
    else
      return stop_edge_.x() + SpanXWord::from_bits(1);
  }
  bool backward() const { return backward_; }
  bool carry() const {
    if constexpr (c_exact)
      return start_edge_.carry();
    else
      return false;
  }
  bool empty() const {
    return backward_ ? start().value() <= stop().value() : start().value() >= stop().value();
  }
  /// Number of pixels of the line. The line must not be empty.
  std::size_t pixels() const {
    const std::int64_t from = start().value(), to = stop().value();
    return static_cast<std::size_t>(backward_ ? from - to : to - from);
  }

 private:
  using StepEdge = std::conditional_t<c_exact, EdgeWalker, SlopeWalker>;

  static SpanXWord span_x(std::span<const std::uint32_t> init, const Field& field) {
    return SpanXWord::from_bits(get_bits(init, field));
  }
  static SlopeWalker::EdgeX edge_x(std::span<const std::uint32_t> init, const Field& field) {
    return SlopeWalker::EdgeX::from_bits(get_bits(init, field));
  }

  StepEdge start_edge_, stop_edge_;
  EdgeStart lower_;  ///< lower section of the stop edge
  bool backward_ = false;
};

}  // namespace halfway::golden

// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/shaders/quadratic_shader.vhd: converts init vectors to fragments, in the hardware's
// order.
#pragma once

#include <array>
#include <cassert>
#include <type_traits>

#include "frame/fragment.hpp"
#include "golden/plane_interpolator.hpp"
#include "golden/quadratic_interpolator.hpp"
#include "golden/saturate.hpp"
#include "golden/triangle_walker.hpp"
#include "golden/unwatched.hpp"
#include "golden/words.hpp"
#include "golden/z_interpolator.hpp"
#include "words/quadratic_layout.hpp"

namespace halfway::golden {

/// A channel of degree 1: a plane interpolator that takes its words from the channel's block.
template <class Preset>
class PlaneChannel : public PlaneInterpolator<Preset::c_intensity_bits> {
 public:
  using Plane = PlaneInterpolator<Preset::c_intensity_bits>;
  using At = typename Preset::init_channel_at;

  void line_load(std::span<const std::uint32_t> init, int block_low) {
    const auto word = [&](const Field& field) {
      return Plane::Value::from_bits(get_bits(init, field, block_low));
    };
    if constexpr (std::is_same_v<Preset, Exact>)
      Plane::line_load(word(At::value), word(At::dx), word(At::de0), word(At::de1));
    else
      Plane::line_load(word(At::value), word(At::dx), word(At::de0), word(At::de0));
  }
};

template <class Preset, int Channels, int Degree = 2>
class QuadraticShader {
  static_assert(Channels == 1 || Channels == 3);
  using Layout = QuadraticLayout<Preset, Degree>;

 public:
  using Channel = std::conditional_t<Degree == 1, PlaneChannel<Preset>, QuadraticInterpolator<Preset>>;
  static constexpr int c_init_bits = Layout::init_bits(Channels);
  static constexpr std::size_t c_init_words = (c_init_bits + 31) / 32;
  static constexpr int init_bits() { return c_init_bits; }
  /// Number of vectors of a triangle.
  static constexpr std::size_t group(std::span<const std::uint32_t>) { return 1; }

  /// Draws one init vector of c_init_words words. Calls emit(fragment) for each covered pixel,
  /// watch.line(*this) when the span stage loads a line, and watch.span(*this, x) at each pixel.
  template <class Emit, class Watch = Unwatched>
  void draw(std::span<const std::uint32_t> init, Emit&& emit, Watch&& watch = {}) {
    assert(init.size() >= c_init_words);
    for (line_load(init);; line_step()) {
      if (!walker_.line_empty()) draw_line(emit, watch);
      if (walker_.line_last()) return;
    }
  }

  const TriangleWalker<Preset>& walker() const { return walker_; }
  /// The triangle walker after it loaded the vector.
  static TriangleWalker<Preset> walker_of(std::span<const std::uint32_t> init) {
    TriangleWalker<Preset> walker;
    walker.line_load(init);
    return walker;
  }

  // Registers, for callbacks.
  const ZInterpolator<Preset>& depth() const { return depth_; }
  const Channel& channel(int c) const { return channel_[static_cast<std::size_t>(c)]; }

 private:
  void line_load(std::span<const std::uint32_t> init) {
    walker_.line_load(init);
    depth_.line_load(init);
    for (int c = 0; c < Channels; ++c) channel_[c].line_load(init, Layout::channel_low(c));
  }
  void line_step() {
    const bool carry = walker_.carry();
    walker_.line_step();
    depth_.line_step(carry);
    for (auto& channel : channel_) channel.line_step(carry);
  }
  void span_load() {
    depth_.span_load();
    for (auto& channel : channel_) channel.span_load();
  }
  void span_step() {
    depth_.span_step();
    for (auto& channel : channel_) channel.span_step();
  }

  template <class Emit, class Watch>
  void draw_line(Emit& emit, Watch& watch) {
    watch.line(*this);
    span_load();
    const SpanXWord stop = walker_.stop(), step = walker_.pixel_step();
    for (SpanXWord x = walker_.start(); x != stop; x += step) {
      watch.span(*this, x);
      emit(fragment(x));
      span_step();
    }
  }

  Fragment fragment(SpanXWord x) const {
    return {.triangle = walker_.triangle(),
            .z = depth_.z(),
            .y = static_cast<std::uint16_t>(walker_.y()),
            .x = static_cast<std::uint16_t>(low_bits(x.bits(), Preset::c_pixel_x_bits)),
            .red = colour(0),
            .green = colour(1),
            .blue = colour(2)};
  }
  /// With one channel (grey) all colours are equal.
  std::uint8_t colour(std::size_t channel) const {
    return static_cast<std::uint8_t>(
        saturate<Preset::c_intensity_bits, Preset::c_intensity_fraction_bits, Preset::c_colour_bits>(
            channel_[Channels == 3 ? channel : 0].value()));
  }

  TriangleWalker<Preset> walker_;
  ZInterpolator<Preset> depth_;
  std::array<Channel, Channels> channel_;
};

}  // namespace halfway::golden

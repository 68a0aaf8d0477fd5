// SPDX-License-Identifier: Apache-2.0
// Twin of rtl/shaders/quadratic_shader.vhd: init vectors to fragments, in the order that the hardware emits
// them.
#pragma once

#include <array>
#include <cassert>
#include <vector>

#include "frame/fragment.hpp"
#include "golden/quadratic_interpolator.hpp"
#include "golden/quadratic_side_by_side.hpp"
#include "golden/saturate.hpp"
#include "golden/triangle_walker.hpp"
#include "golden/unwatched.hpp"
#include "golden/z_interpolator.hpp"

namespace halfway::golden {

template <class Preset, int Channels>
class QuadraticShader {
  static_assert(Channels == 1 || Channels == 3);

 public:
  static constexpr int c_init_bits = Preset::c_init_header_bits + Channels * Preset::c_init_channel_bits;
  static constexpr int c_probe_bits = Preset::c_probe_header_bits + Channels * Preset::c_probe_channel_bits;
  static constexpr std::size_t c_init_words = (c_init_bits + 31) / 32;
  static constexpr int init_bits() { return c_init_bits; }
  static constexpr int probe_bits() { return c_probe_bits; }
  /// Vectors that make a triangle.
  static constexpr std::size_t group(std::span<const std::uint32_t>) { return 1; }
  static constexpr std::size_t c_probe_words = (c_probe_bits + 31) / 32;

  /// Draws one init vector of c_init_words words: emit(Fragment) for each pixel; watch.line where the span
  /// stage takes a line, watch.span for each pixel, as the RTL's probe. Faster where emit.room(n) gives room
  /// for n fragments in place of taking them one by one; nothing is watched then.
  template <class Emit, class Watch = Unwatched>
  void draw(std::span<const std::uint32_t> init, Emit&& emit, Watch&& watch = {}) {
    assert(init.size() >= c_init_words);
    if constexpr (requires { emit.room(std::size_t{}); })
      draw_unwatched(init, emit);
    else
      draw_watched(init, emit, watch);
  }

  const TriangleWalker<Preset>& walker() const { return walker_; }
  /// As the vector loads it.
  static TriangleWalker<Preset> walker_of(std::span<const std::uint32_t> init) {
    TriangleWalker<Preset> walker;
    walker.line_load(init);
    return walker;
  }

  /// The stages' registers as the RTL's probe carries them.
  std::array<std::uint32_t, c_probe_words> line_probe() const {
    using At = typename Preset::probe_header_at;
    using ChannelAt = typename Preset::probe_channel_at;
    std::array<std::uint32_t, c_probe_words> words{};
    set_bits(words, At::line_event, 1);
    set_bits(words, At::line_y, walker_.y());
    set_bits(words, At::line_start, walker_.start().bits());
    set_bits(words, At::line_stop, walker_.stop().bits());
    if constexpr (std::is_same_v<Preset, Exact>) set_bits(words, At::line_carry, walker_.carry());
    set_bits(words, At::line_z, depth_.line_value().bits());
    for (int c = 0; c < Channels; ++c) {
      const int low = Preset::c_probe_header_bits + c * Preset::c_probe_channel_bits;
      set_bits(words, ChannelAt::line_value, channel_[c].line_value().bits(), low);
      set_bits(words, ChannelAt::line_dx, channel_[c].line_dx().bits(), low);
      set_bits(words, ChannelAt::line_de0, channel_[c].line_de0().bits(), low);
      if constexpr (std::is_same_v<Preset, Exact>)
        set_bits(words, ChannelAt::line_de1, channel_[c].line_de1().bits(), low);
    }
    return words;
  }
  std::array<std::uint32_t, c_probe_words> span_probe(SpanXWord x) const {
    using At = typename Preset::probe_header_at;
    using ChannelAt = typename Preset::probe_channel_at;
    std::array<std::uint32_t, c_probe_words> words{};
    set_bits(words, At::span_event, 1);
    set_bits(words, At::span_y, walker_.y());
    set_bits(words, At::span_x, x.bits());
    set_bits(words, At::span_z, depth_.value().bits());
    for (int c = 0; c < Channels; ++c) {
      const int low = Preset::c_probe_header_bits + c * Preset::c_probe_channel_bits;
      set_bits(words, ChannelAt::span_value, channel_[c].value().bits(), low);
      set_bits(words, ChannelAt::span_dx, channel_[c].dx().bits(), low);
    }
    return words;
  }

 private:
  template <class Emit>
  void draw_unwatched(std::span<const std::uint32_t> init, Emit& emit) {
    walker_.line_load(init);
    QuadraticSideBySide<Preset, Channels> interpolators;
    interpolators.line_load(init);
    walker_.walk(
        [&] {
          if (walker_.line_empty()) return;
          const std::size_t count = walker_.pixels();
          interpolators.draw_span(walker_.triangle(), walker_.y(),
                                  static_cast<std::uint64_t>(walker_.start().value()),
                                  static_cast<std::uint64_t>(walker_.pixel_step()), count, emit.room(count));
        },
        [&](bool carry) { interpolators.line_step(carry); });
  }

  template <class Emit, class Watch>
  void draw_watched(std::span<const std::uint32_t> init, Emit& emit, Watch& watch) {
    walker_.line_load(init);
    depth_.line_load(init);
    for (int c = 0; c < Channels; ++c)
      channel_[c].line_load(init, Preset::c_init_header_bits + c * Preset::c_init_channel_bits);
    walker_.walk(
        [&] {
          if (walker_.line_empty()) return;
          watch.line(*this);
          draw_span(emit, watch);
        },
        [&](bool carry) {
          depth_.line_step(carry);
          for (auto& channel : channel_) channel.line_step(carry);
        });
  }

  template <class Emit, class Watch>
  void draw_span(Emit& emit, Watch& watch) {
    depth_.span_load();
    for (auto& channel : channel_) channel.span_load();
    const SpanXWord stop = walker_.stop();
    const auto step = SpanXWord::from_bits(static_cast<std::uint64_t>(walker_.pixel_step()));
    Fragment fragment = span_fragment();
    for (SpanXWord x = walker_.start(); x != stop; x += step) {
      watch.span(*this, x);
      set_pixel(fragment, x.bits(), depth_.value(), channel_[0].value(),
                channel_[Channels == 3 ? 1 : 0].value(), channel_[Channels == 3 ? 2 : 0].value());
      emit(fragment);
      depth_.span_step();
      for (auto& channel : channel_) channel.span_step();
    }
  }

  Fragment span_fragment() const {
    Fragment fragment{};
    fragment.triangle = walker_.triangle();
    fragment.y = static_cast<std::uint16_t>(walker_.y());
    return fragment;
  }
  using Depth = Word<Preset::c_depth_sum_bits>;
  using Intensity = Word<Preset::c_intensity_bits>;
  static void set_pixel(Fragment& fragment, std::uint64_t x, Depth depth, Intensity red, Intensity green,
                        Intensity blue) {
    fragment.x = static_cast<std::uint16_t>(low_bits(x, Preset::c_pixel_x_bits));
    fragment.z = static_cast<std::uint32_t>(
        low_bits(depth.bits() >> Preset::c_depth_sum_fraction_bits, Preset::c_depth_bits));
    fragment.red = colour(red);
    fragment.green = colour(green);
    fragment.blue = colour(blue);
  }
  static std::uint8_t colour(Intensity intensity) {
    return static_cast<std::uint8_t>(
        saturate<Preset::c_intensity_bits, Preset::c_intensity_fraction_bits, Preset::c_colour_bits>(
            intensity));
  }

  TriangleWalker<Preset> walker_;
  ZInterpolator<Preset> depth_;
  std::array<QuadraticInterpolator<Preset>, Channels> channel_;
};

}  // namespace halfway::golden

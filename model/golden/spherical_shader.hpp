// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/shaders/spherical_shader.vhd: converts a triangle's header and line records to
// fragments, in the hardware's order.
#pragma once

#include <array>
#include <cassert>
#include <vector>

#include "frame/fragment.hpp"
#include "golden/diffuse_slice.hpp"
#include "golden/saturating_sum.hpp"
#include "golden/specular_slice.hpp"
#include "golden/spherical_layout.hpp"
#include "golden/triangle_walker.hpp"
#include "golden/unwatched.hpp"
#include "golden/z_interpolator.hpp"

namespace halfway::golden {

template <class Preset>
class SphericalShader {
 public:
  explicit SphericalShader(const SphericalConfig& config) : config_(config), layout_(config) {
    assert(config.channels == 1 || config.channels == 3);
    assert(config.highlight_channels == 1 || config.highlight_channels == config.channels);
    assert(config.lights >= 0);
    const auto lights = static_cast<std::size_t>(config.lights);
    if (layout_.has_diffuse_part())
      diffuse_.assign(lights, DiffuseSlice<Preset>(layout_.diffuse_channels(), config.address_bits,
                                                   config.data_bits, config.tables));
    if (config.specular)
      specular_.assign(lights, SpecularSlice<Preset>(config.highlight_channels, config.powers,
                                                     config.address_bits, config.data_bits, config.tables));
  }

  int init_bits() const { return layout_.init_bits(); }
  std::size_t init_words() const { return words_of(init_bits()); }

  /// Number of init vectors of the triangle with this header: the header, and one line record per line.
  std::size_t group(std::span<const std::uint32_t> header) const {
    if (layout_.record_bits() == 0) return 1;
    using At = typename Preset::init_header_at;
    // A counter loaded with zero counts a full period.
    std::size_t lines = get_bits(header, At::upper_lines);
    if (lines == 0) lines = std::size_t{1} << Preset::c_lines_bits;
    if constexpr (SphericalLayout<Preset>::c_exact) lines += get_bits(header, At::lower_lines);
    return 1 + lines;
  }

  /// Draws the init vectors of one group, init_words() words each. Calls emit(fragment) for each covered
  /// pixel, watch.line(*this) when the span stage loads a line, and watch.span(*this, x) at each pixel.
  template <class Emit, class Watch = Unwatched>
  void draw(std::span<const std::uint32_t> vectors, Emit&& emit, Watch&& watch = {}) {
    assert(vectors.size() >= init_words() && vectors.size() >= group(vectors) * init_words());
    for (line_load(vectors);; line_step()) {
      if (layout_.record_bits() != 0) vectors = vectors.subspan(init_words());
      if (!walker_.line_empty()) draw_line(vectors, emit, watch);
      if (walker_.line_last()) return;
    }
  }

  const TriangleWalker<Preset>& walker() const { return walker_; }
  /// The triangle walker after it loaded the header.
  static TriangleWalker<Preset> walker_of(std::span<const std::uint32_t> header) {
    TriangleWalker<Preset> walker;
    walker.line_load(header);
    return walker;
  }

  // Registers, for callbacks.
  const ZInterpolator<Preset>& depth() const { return depth_; }
  const DiffuseSlice<Preset>& diffuse(std::size_t light) const { return diffuse_[light]; }
  const SpecularSlice<Preset>& specular(std::size_t light) const { return specular_[light]; }
  bool lit(std::size_t light) const { return diffuse_.empty() || diffuse_[light].lit(); }

 private:
  static constexpr std::size_t words_of(int bits) { return static_cast<std::size_t>(bits + 31) / 32; }

  void line_load(std::span<const std::uint32_t> header) {
    walker_.line_load(header);
    depth_.line_load(header);
    for (int c = 0; c < config_.channels; ++c)
      ambient_[static_cast<std::size_t>(c)] = static_cast<std::uint32_t>(
          get_bits(header, Preset::ambient_channel_at::ambient, layout_.ambient_low(c)));
  }
  void line_step() {
    const bool carry = walker_.carry();
    walker_.line_step();
    depth_.line_step(carry);
  }
  void span_load(std::span<const std::uint32_t> record) {
    depth_.span_load();
    for (int l = 0; l < config_.lights; ++l) {
      const auto light = static_cast<std::size_t>(l);
      if (!diffuse_.empty()) diffuse_[light].span_load(record, layout_.diffuse_low(l));
      if (!specular_.empty()) specular_[light].span_load(record, layout_.specular_low(l));
    }
  }
  void span_step() {
    depth_.span_step();
    for (auto& slice : diffuse_) slice.span_step();
    for (auto& slice : specular_) slice.span_step();
  }

  template <class Emit, class Watch>
  void draw_line(std::span<const std::uint32_t> record, Emit& emit, Watch& watch) {
    watch.line(*this);
    span_load(record);
    const SpanXWord stop = walker_.stop(), step = walker_.pixel_step();
    for (SpanXWord x = walker_.start(); x != stop; x += step) {
      watch.span(*this, x);
      emit(fragment(x));
      span_step();
    }
  }

  Fragment fragment(SpanXWord x) const {
    const auto sums = channel_sums();
    // With one channel (grey) all colours are equal.
    const auto colour = [&](std::size_t channel) {
      return static_cast<std::uint8_t>(sums[config_.channels == 3 ? channel : 0].result(
          Preset::c_factor_fraction_bits + config_.data_bits, Preset::c_colour_bits));
    };
    return {.triangle = walker_.triangle(),
            .z = depth_.z(),
            .y = static_cast<std::uint16_t>(walker_.y()),
            .x = static_cast<std::uint16_t>(low_bits(x.bits(), Preset::c_pixel_x_bits)),
            .red = colour(0),
            .green = colour(1),
            .blue = colour(2)};
  }

  /// One sum per channel: ambient light and the products of all slices.
  std::array<SaturatingSum, 3> channel_sums() const {
    std::array<SaturatingSum, 3> sums;
    for (int c = 0; c < config_.channels; ++c) sums[c].add(std::uint64_t{ambient_[c]} << config_.data_bits);
    for (const auto& slice : diffuse_) {
      const std::uint32_t sample = slice.gated_sample();
      for (int c = 0; c < config_.channels; ++c) sums[c].add(slice.product(c, sample));
    }
    for (std::size_t light = 0; light < specular_.size(); ++light) {
      const auto& slice = specular_[light];
      const std::uint32_t sample = slice.gated_sample(lit(light));
      for (int c = 0; c < config_.channels; ++c)
        sums[c].add(slice.product(config_.highlight_channels == 1 ? 0 : c, sample));
    }
    return sums;
  }

  SphericalConfig config_;
  SphericalLayout<Preset> layout_;
  TriangleWalker<Preset> walker_;
  ZInterpolator<Preset> depth_;
  std::array<std::uint32_t, 3> ambient_{};
  std::vector<DiffuseSlice<Preset>> diffuse_;    // one per light, or none
  std::vector<SpecularSlice<Preset>> specular_;  // one per light, or none
};

}  // namespace halfway::golden

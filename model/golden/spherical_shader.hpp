// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/shaders/spherical_shader.vhd: converts a triangle's header and line records to
// fragments, in the hardware's order.
#pragma once

#include <cassert>
#include <vector>

#include "frame/fragment.hpp"
#include "golden/ambient_light.hpp"
#include "golden/colour_sum.hpp"
#include "golden/spherical_light.hpp"
#include "golden/triangle_walker.hpp"
#include "golden/unwatched.hpp"
#include "golden/words.hpp"
#include "golden/z_interpolator.hpp"
#include "words/spherical_layout.hpp"

namespace halfway::golden {

template <class Preset>
class SphericalShader {
 public:
  explicit SphericalShader(const SphericalConfig& config)
      : config_(config), layout_(config), ambient_(config.channels, config.size.data_bits) {
    assert(config.channels == 1 || config.channels == 3);
    assert(config.lights >= 0);
    if (config.diffuse || config.specular)
      lights_.assign(static_cast<std::size_t>(config.lights), SphericalLight<Preset>(config));
  }

  int init_bits() const { return layout_.init_bits(); }
  std::size_t init_words() const { return static_cast<std::size_t>(init_bits() + 31) / 32; }

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
  const DiffuseSlice<Preset>& diffuse(std::size_t light) const { return lights_[light].diffuse(); }
  const SpecularSlice<Preset>& specular(std::size_t light) const { return lights_[light].specular(); }
  bool lit(std::size_t light) const { return lights_[light].lit(); }

 private:
  void line_load(std::span<const std::uint32_t> header) {
    walker_.line_load(header);
    depth_.line_load(header);
    // All spans of the triangle have its ambient light.
    ambient_.span_load(header, layout_.ambient_low(0));
  }
  void line_step() {
    const bool carry = walker_.carry();
    walker_.line_step();
    depth_.line_step(carry);
  }
  void span_load(std::span<const std::uint32_t> record) {
    depth_.span_load();
    int number = 0;
    for (auto& light : lights_) light.span_load(record, number++);
  }
  void span_step() {
    depth_.span_step();
    for (auto& light : lights_) light.span_step();
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
    ColourSum<Preset> sum(config_.channels, config_.size.data_bits);
    const auto add = [&](const ColourTerms& terms) { sum.add(terms); };
    add(ambient_.terms());
    for (const auto& light : lights_) light.add_terms(add);
    const auto [red, green, blue] = sum.colours();
    return {.triangle = walker_.triangle(),
            .z = depth_.z(),
            .y = static_cast<std::uint16_t>(walker_.y()),
            .x = static_cast<std::uint16_t>(low_bits(x.bits(), Preset::c_pixel_x_bits)),
            .red = red,
            .green = green,
            .blue = blue};
  }

  SphericalConfig config_;
  SphericalLayout<Preset> layout_;
  TriangleWalker<Preset> walker_;
  ZInterpolator<Preset> depth_;
  AmbientLight<Preset> ambient_;
  std::vector<SphericalLight<Preset>> lights_;  // none without diffuse light and highlights
};

}  // namespace halfway::golden

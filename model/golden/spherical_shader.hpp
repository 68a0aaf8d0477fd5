// SPDX-License-Identifier: Apache-2.0
// Twin of rtl/shaders/spherical_shader.vhd: a triangle's header and line records to fragments, in the order
// that the hardware emits them.
#pragma once

#include <array>
#include <cassert>
#include <vector>

#include "frame/fragment.hpp"
#include "golden/diffuse_slice.hpp"
#include "golden/saturating_sum.hpp"
#include "golden/specular_slice.hpp"
#include "golden/spherical_layout.hpp"
#include "golden/spherical_side_by_side.hpp"
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
  int probe_bits() const { return layout_.probe_bits(); }
  std::size_t init_words() const { return words_of(init_bits()); }

  /// Init vectors that the triangle of this header takes: itself, and a line record for every line.
  std::size_t group(std::span<const std::uint32_t> header) const {
    if (layout_.record_bits() == 0) return 1;
    using At = typename Preset::init_header_at;
    // A counter that stands at zero goes all the way round.
    std::size_t lines = get_bits(header, At::upper_lines);
    if (lines == 0) lines = std::size_t{1} << Preset::c_lines_bits;
    if constexpr (SphericalLayout<Preset>::c_exact) lines += get_bits(header, At::lower_lines);
    return 1 + lines;
  }

  /// Draws the init vectors of one group, init_words() words each: emit(Fragment) for each pixel; watch.line
  /// where the span stage takes a line, watch.span, watch.sample and watch.product for each pixel, as the
  /// RTL's probe. Faster where emit.room(n) gives room for n fragments, and for three more that mean
  /// nothing, in place of taking them one by one; nothing is watched then.
  template <class Emit, class Watch = Unwatched>
  void draw(std::span<const std::uint32_t> vectors, Emit&& emit, Watch&& watch = {}) {
    assert(vectors.size() >= init_words() && vectors.size() >= group(vectors) * init_words());
    walker_.line_load(vectors);
    depth_.line_load(vectors);
    for (int c = 0; c < config_.channels; ++c)
      ambient_[static_cast<std::size_t>(c)] = static_cast<std::uint32_t>(
          get_bits(vectors, Preset::ambient_channel_at::ambient, layout_.ambient_low(c)));
    walker_.walk(
        [&] {
          if (layout_.record_bits() != 0) vectors = vectors.subspan(init_words());
          if (walker_.line_empty()) return;
          watch.line(*this);
          span_load(vectors);
          draw_span(emit, watch);
        },
        [&](bool carry) { depth_.line_step(carry); });
  }

  const TriangleWalker<Preset>& walker() const { return walker_; }
  /// As the header loads it.
  static TriangleWalker<Preset> walker_of(std::span<const std::uint32_t> header) {
    TriangleWalker<Preset> walker;
    walker.line_load(header);
    return walker;
  }

  /// The stages' registers as the RTL's probe carries them; each of the last three at the pixel that the span
  /// stands at.
  std::vector<std::uint32_t> line_probe() const {
    using At = typename Preset::probe_header_at;
    auto words = probe_words(At::line_event);
    set_bits(words, At::line_y, walker_.y());
    set_bits(words, At::line_start, walker_.start().bits());
    set_bits(words, At::line_stop, walker_.stop().bits());
    if constexpr (SphericalLayout<Preset>::c_exact) set_bits(words, At::line_carry, walker_.carry());
    set_bits(words, At::line_z, depth_.line_value().bits());
    return words;
  }
  std::vector<std::uint32_t> span_probe(SpanXWord x) const {
    using At = typename Preset::probe_header_at;
    auto words = probe_words(At::span_event);
    set_bits(words, At::span_y, walker_.y());
    set_bits(words, At::span_x, x.bits());
    set_bits(words, At::span_z, depth_.value().bits());
    for_each_slice(
        [&](const auto& slice, int low) {
          set_bits(words, Preset::diffuse_probe_header_at::angle, slice.angle().bits(), low);
        },
        [&](const auto& slice, bool, int low) {
          set_bits(words, Preset::specular_probe_header_at::angle, slice.angle().bits(), low);
        });
    return words;
  }
  std::vector<std::uint32_t> sample_probe() const {
    auto words = probe_words(Preset::probe_header_at::sample_event);
    for_each_slice(
        [&](const auto& slice, int low) {
          set_bits(words, Preset::diffuse_probe_header_at::in_range, slice.lit(), low);
          set_bits(words, Preset::diffuse_probe_header_at::sample, slice.sample(), low);
        },
        [&](const auto& slice, bool lit, int low) {
          set_bits(words, Preset::specular_probe_header_at::in_range, slice.in_range(lit), low);
          set_bits(words, Preset::specular_probe_header_at::sample, slice.sample(), low);
        });
    return words;
  }
  std::vector<std::uint32_t> product_probe() const {
    auto words = probe_words(Preset::probe_header_at::product_event);
    for_each_slice(
        [&](const auto& slice, int low) {
          for (int c = 0; c < layout_.diffuse_channels(); ++c)
            set_bits(words, Preset::diffuse_probe_channel_at::product, slice.product(c),
                     low + Preset::c_diffuse_probe_header_bits + c * Preset::c_diffuse_probe_channel_bits);
        },
        [&](const auto& slice, bool lit, int low) {
          for (int c = 0; c < config_.highlight_channels; ++c)
            set_bits(words, Preset::specular_probe_channel_at::product, slice.product(c, lit),
                     low + Preset::c_specular_probe_header_bits + c * Preset::c_specular_probe_channel_bits);
        });
    return words;
  }

 private:
  static constexpr std::size_t words_of(int bits) { return static_cast<std::size_t>(bits + 31) / 32; }

  std::vector<std::uint32_t> probe_words(const Field& happened) const {
    std::vector<std::uint32_t> words(words_of(probe_bits()));
    set_bits(words, happened, 1);
    return words;
  }
  bool lit(std::size_t light) const { return diffuse_.empty() || diffuse_[light].lit(); }
  /// diffuse(slice, low) and specular(slice, lit, low) for every light's parts of the probe.
  template <class Diffuse, class Specular>
  void for_each_slice(Diffuse&& diffuse, Specular&& specular) const {
    for (int l = 0; l < config_.lights; ++l) {
      const auto light = static_cast<std::size_t>(l);
      if (!diffuse_.empty()) diffuse(diffuse_[light], layout_.diffuse_probe_low(l));
      if (!specular_.empty()) specular(specular_[light], lit(light), layout_.specular_probe_low(l));
    }
  }

  struct Light {
    const DiffuseSlice<Preset>& diffuse;
    const SpecularSlice<Preset>& specular;
  };
  Light light_at(std::size_t light) const {
    return {diffuse_.empty() ? no_diffuse_ : diffuse_[light],
            specular_.empty() ? no_specular_ : specular_[light]};
  }

  void span_load(std::span<const std::uint32_t> record) {
    depth_.span_load();
    for (int l = 0; l < config_.lights; ++l) {
      const auto light = static_cast<std::size_t>(l);
      if (!diffuse_.empty()) diffuse_[light].span_load(record, layout_.diffuse_low(l));
      if (!specular_.empty()) specular_[light].span_load(record, layout_.specular_low(l));
    }
  }

  template <class Emit, class Watch>
  void draw_span(Emit& emit, Watch& watch) {
    Fragment fragment{};
    fragment.triangle = walker_.triangle();
    fragment.y = static_cast<std::uint16_t>(walker_.y());
    if constexpr (requires { emit.room(std::size_t{}); }) {
      const std::int64_t from = walker_.start().value();
      const std::size_t count = walker_.pixels();
      Fragment* out = emit.room(count);
      if (config_.channels == 1)
        draw_run<1, false>(fragment, from, count, out);
      else if (config_.highlight_channels == 1)
        draw_run<3, false>(fragment, from, count, out);
      else
        draw_run<3, true>(fragment, from, count, out);
    } else {
      const SpanXWord stop = walker_.stop();
      const auto step = SpanXWord::from_bits(static_cast<std::uint64_t>(walker_.pixel_step()));
      for (SpanXWord x = walker_.start(); x != stop; x += step) {
        watch.span(*this, x);
        watch.sample(*this, x);
        watch.product(*this, x);
        if (config_.channels == 1)
          set_pixel<1>(fragment, x.bits(), depth_, pixel_sums<1>().data());
        else
          set_pixel<3>(fragment, x.bits(), depth_, pixel_sums<3>().data());
        emit(fragment);
        depth_.span_step();
        for (auto& slice : diffuse_) slice.span_step();
        for (auto& slice : specular_) slice.span_step();
      }
    }
  }

  // The last block of four is drawn whole: emit.room() has room for that.
  template <int Channels, bool Coloured>
  void draw_run(const Fragment& line, std::int64_t from, std::size_t count, Fragment* out) {
    FourSums start{};
    const auto ambient = ambient_sums<Channels>();
    for (std::size_t c = 0; c < Channels; ++c) start.channel[c] = FourWords{} + ambient[c].sum();
    FourSteps<Preset::c_depth_sum_bits> depth(depth_.value(), depth_.dx());
    const auto step = static_cast<std::uint64_t>(walker_.pixel_step());
    auto x = static_cast<std::uint64_t>(from);
    const auto put = [&](const FourWords* sums) {
      put_pixels<Preset, Channels>(line, x, step, depth.aligned(), sums, config_.data_bits, out);
      out += 4;
      x += 4 * step;
      depth.step();
    };
    if (config_.lights == 1) {
      const Light light = light_at(0);
      FourLit<Preset> lit(light.diffuse, light.specular);
      for (std::size_t i = 0; i < count; i += 4, lit.step()) {
        FourSums sums = start;
        lit.template add_to<Channels, Coloured>(sums.channel);
        put(sums.channel);
      }
      return;
    }
    // One light after the other over the whole span.
    sums_.assign((count + 3) / 4, start);
    for (std::size_t l = 0; l < static_cast<std::size_t>(config_.lights); ++l) {
      const Light light = light_at(l);
      FourLit<Preset> lit(light.diffuse, light.specular);
      for (FourSums& sums : sums_) {
        lit.template add_to<Channels, Coloured>(sums.channel);
        lit.step();
      }
    }
    for (const FourSums& sums : sums_) put(sums.channel);
  }

  /// What the adders have before any light.
  template <int Channels>
  std::array<SaturatingSum, Channels> ambient_sums() const {
    std::array<SaturatingSum, Channels> sums;
    for (std::size_t c = 0; c < Channels; ++c) sums[c].add(std::uint64_t{ambient_[c]} << config_.data_bits);
    return sums;
  }
  template <int Channels>
  std::array<SaturatingSum, Channels> pixel_sums() const {
    auto sums = ambient_sums<Channels>();
    for (std::size_t l = 0; l < static_cast<std::size_t>(config_.lights); ++l) {
      const Light light = light_at(l);
      if (config_.highlight_channels == Channels)
        add_light<Channels, true>(light.diffuse, light.specular, sums.data());
      else
        add_light<Channels, false>(light.diffuse, light.specular, sums.data());
    }
    return sums;
  }
  // A slice that is not there has no table, and so no sample; its horizon is nowhere.
  template <int Channels, bool Coloured>
  static void add_light(const DiffuseSlice<Preset>& diffuse, const SpecularSlice<Preset>& specular,
                        SaturatingSum* sums) {
    const std::uint32_t cosine = diffuse.gated(), highlight = specular.gated(diffuse.lit());
    for (int c = 0; c < Channels; ++c) {
      sums[c].add(diffuse.product(c, cosine));
      sums[c].add(specular.product(Coloured ? c : 0, highlight));
    }
  }

  template <int Channels>
  void set_pixel(Fragment& fragment, std::uint64_t x, const ZInterpolator<Preset>& depth,
                 const SaturatingSum* sums) const {
    const auto colour = [&](int channel) {
      return static_cast<std::uint8_t>(sums[Channels == 3 ? channel : 0].result(
          Preset::c_factor_fraction_bits + config_.data_bits, Preset::c_colour_bits));
    };
    fragment.x = static_cast<std::uint16_t>(low_bits(x, Preset::c_pixel_x_bits));
    fragment.z = static_cast<std::uint32_t>(
        low_bits(depth.value().bits() >> Preset::c_depth_sum_fraction_bits, Preset::c_depth_bits));
    fragment.red = colour(0);
    fragment.green = colour(1);
    fragment.blue = colour(2);
  }

  SphericalConfig config_;
  SphericalLayout<Preset> layout_;
  TriangleWalker<Preset> walker_;
  ZInterpolator<Preset> depth_;
  std::array<std::uint32_t, 3> ambient_{};
  std::vector<DiffuseSlice<Preset>> diffuse_;    // one a light, or none
  std::vector<SpecularSlice<Preset>> specular_;  // one a light, or none
  const DiffuseSlice<Preset> no_diffuse_{};
  const SpecularSlice<Preset> no_specular_{};
  std::vector<FourSums> sums_;  // of a span's pixels
};

}  // namespace halfway::golden

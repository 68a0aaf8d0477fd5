// SPDX-License-Identifier: Apache-2.0
// The z interpolator and the channels' quadratic interpolators in one vector: the same steps as their twins
// take one by one, for speed where no register is watched.
#pragma once

#include <cstring>
#include <type_traits>

#include "golden/four_words.hpp"
#include "golden/word.hpp"

namespace halfway::golden {

/// Depth, red, green, blue: a word each, at the top of 64 bits, so that sums wrap alike whatever their
/// widths.
template <class Preset, int Channels>
class QuadraticSideBySide {
 public:
  using At = typename Preset::init_channel_at;
  using HeaderAt = typename Preset::init_header_at;
  static constexpr bool c_carries = std::is_same_v<Preset, Exact>;

  void line_load(std::span<const std::uint32_t> init) {
    const FourWords none{};
    value_ = words(init, HeaderAt::z, At::value);
    dx_ = words(init, HeaderAt::z_dx, At::dx);
    de0_ = words(init, HeaderAt::z_de0, At::de0);
    dxx_ = channel_words(init, At::dxx, none);  // the depth's second differences are zero
    dxe0_ = channel_words(init, At::dxe0, none);
    de0e0_ = channel_words(init, At::de0e0, none);
    if constexpr (c_carries) {
      de1_ = words(init, HeaderAt::z_de1, At::de1);
      dxe1_ = channel_words(init, At::dxe1, none);
      de0e1_ = channel_words(init, At::de0e1, none);
      de1e1_ = channel_words(init, At::de1e1, none);
    }
  }
  void line_step(bool carry) {
    if constexpr (c_carries) {
      const FourWords with = FourWords{} - std::uint64_t{carry};  // all ones or zeros
      const auto choose = [&](const FourWords& a, const FourWords& b) __attribute__((always_inline)) {
        return (a & with) | (b & ~with);
      };
      value_ += choose(de1_, de0_);
      dx_ += choose(dxe1_, dxe0_);
      de0_ += choose(de0e1_, de0e0_);
      de1_ += choose(de1e1_, de0e1_);
    } else {
      value_ += de0_;
      dx_ += dxe0_;
      de0_ += de0e0_;
    }
  }

  /// The line's pixels: `count` of them from x on, `step` apart.
  void draw_span(std::uint32_t triangle, std::uint32_t y, std::uint64_t x, std::uint64_t step,
                 std::size_t count, Fragment* out) const {
    FourWords value = value_, dx = dx_;
    const FourWords dxx = dxx_;
    const std::uint64_t low = triangle, high = static_cast<std::uint16_t>(y);
    for (std::size_t i = 0; i < count; ++i, x += step) {
      const FourWords pixel = saturated(value);
      // Each to its place in a fragment's two halves.
      const FourWords nothing{};
      const TwoWords halves = __builtin_shufflevector(pixel, nothing, 0, 1) |
                              __builtin_shufflevector(pixel, nothing, 4, 2) |
                              __builtin_shufflevector(pixel, nothing, 4, 3) |
                              TwoWords{low, high | low_bits(x, Preset::c_pixel_x_bits) << 16};
      std::memcpy(static_cast<void*>(out++), &halves, sizeof halves);
      value += dx;
      dx += dxx;
    }
  }

 private:
  using TwoWords = std::uint64_t __attribute__((vector_size(16)));

  [[gnu::always_inline]] static FourWords channel_words(std::span<const std::uint32_t> init,
                                                        const Field& field, FourWords words) {
    for (int c = 0; c < 3; ++c) {
      const int low = Preset::c_init_header_bits + (Channels == 3 ? c : 0) * Preset::c_init_channel_bits;
      words[1 + c] = get_bits(init, field, low) << (64 - Preset::c_intensity_bits);
    }
    return words;
  }
  [[gnu::always_inline]] static FourWords words(std::span<const std::uint32_t> init, const Field& depth,
                                                const Field& channel) {
    return channel_words(init, channel,
                         FourWords{get_bits(init, depth) << (64 - Preset::c_depth_sum_bits), 0, 0, 0});
  }

  /// As saturate() does a colour's word; of the depth the lowest bits. Each where a fragment has it.
  [[gnu::always_inline]] static FourWords saturated(const FourWords& words) {
    constexpr int c_depth = 64 - Preset::c_depth_sum_bits + Preset::c_depth_sum_fraction_bits;
    constexpr int c_colour = 64 - Preset::c_intensity_bits + Preset::c_intensity_fraction_bits;
    constexpr std::int64_t c_most = (std::int64_t{1} << (c_colour + Preset::c_colour_bits)) - 1;
    const FourSigned lowest = {INT64_MIN, 0, 0, 0}, highest = {INT64_MAX, c_most, c_most, c_most};
    auto held = (FourSigned)words;
    held = held < lowest ? lowest : held;
    held = held > highest ? highest : held;
    const FourWords whole = (FourWords)held >> FourWords{c_depth, c_colour, c_colour, c_colour};
    constexpr std::uint64_t c_depth_mask = (std::uint64_t{1} << Preset::c_depth_bits) - 1;
    constexpr std::uint64_t c_mask = (std::uint64_t{1} << Preset::c_colour_bits) - 1;
    return (whole & FourWords{c_depth_mask, c_mask, c_mask, c_mask}) << FourWords{32, 32, 40, 48};
  }

  FourWords value_{}, dx_{}, de0_{}, de1_{};
  FourWords dxx_{}, dxe0_{}, dxe1_{}, de0e0_{}, de0e1_{}, de1e1_{};
};

}  // namespace halfway::golden

// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/objects/pixel_filter.vhd and filter_pkg.vhd: filters a strip's pixels over 2x2 pixels.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "frame/fragment.hpp"
#include "golden/shading_token.hpp"
#include "words/object_limits.hpp"

namespace halfway::golden {

using words::FilterWeights, words::c_filter_weights;

/// Three colours of 8 bits. One channel has the first one.
using Background = std::array<std::uint8_t, 3>;

/// That of the frame which a token new_frame starts.
template <class Preset>
Background background_of(const ShadingToken<Preset>& new_frame, int channels) {
  Background background{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(channels); ++i)
    background[i] =
        static_cast<std::uint8_t>(new_frame.light.intensity[i] >> Preset::c_light_intensity_fraction_bits);
  return background;
}

template <class Preset>
class PixelFilter {
 public:
  using Token = ShadingToken<Preset>;

  PixelFilter(int channels, std::int64_t subpixels, const Background& background,
              const FilterWeights& weights = c_filter_weights)
      : channels_(static_cast<std::size_t>(channels)),
        subpixels_(subpixels),
        background_(background),
        weights_(weights),
        line_(std::size_t{1} << Preset::c_pixel_x_bits) {}

  /// Not within a strip.
  void set_background(const Background& background) { background_ = background; }

  /// Takes a token with the number of subpixels that its object covers, and calls emit(fragment) if the token
  /// ends a pixel whose support has an object.
  template <class Emit>
  void take(const Token& token, std::uint32_t weight, Emit&& emit) {
    const bool head = is_head(token.command);
    if (pixel_ && (head || token.command == Command::new_frame)) end_pixel(emit);
    if (head)
      start_pixel(token);
    else if (token.command == Command::new_frame)
      pixel_.reset();
    else if (token.command == Command::new_object && pixel_)
      add_object(token, weight);
  }

 private:
  static constexpr int c_fraction = Preset::c_radiance_fraction_bits;
  static constexpr std::int64_t c_half = (std::int64_t{1} << c_fraction) / 2;
  static constexpr std::int64_t c_white =
      (std::int64_t{(1 << Preset::c_colour_bits) - 1} << c_fraction) + c_half;

  /// The sum of a pixel's subpixels per channel, and its nearest object.
  struct Pixel {
    std::array<std::int64_t, 3> sums{};
    bool object = false;
    std::uint32_t z = 0, triangle = 0;
  };
  struct Place {
    std::uint32_t y = 0, x = 0;
    bool first_line = true, first_column = true;  ///< of the strip
  };

  std::int64_t behind(std::size_t channel) const {
    return (std::int64_t{background_[channel]} << c_fraction) + c_half;
  }

  void start_pixel(const Token& token) {
    const bool line = token.command == Command::new_scanline;
    place_ = {.y = token.y,
              .x = token.x,
              .first_line = !pixel_ || (place_.first_line && !line),
              .first_column = !pixel_ || line};
    pixel_ = Pixel{};
    covered_ = 0;
  }
  void add_object(const Token& token, std::uint32_t weight) {
    for (std::size_t i = 0; i < channels_; ++i)
      pixel_->sums[i] += weight * std::min<std::int64_t>(token.radiance[i], c_white);
    covered_ += weight;
    if (pixel_->object) return;
    pixel_->object = true;
    pixel_->z = token.z;
    pixel_->triangle = token.triangle;
  }
  template <class Emit>
  void end_pixel(Emit& emit) {
    for (std::size_t i = 0; i < channels_; ++i) pixel_->sums[i] += (subpixels_ - covered_) * behind(i);
    const Pixel above = line_[place_.x];
    const std::array<const Pixel*, 4> support = {
        &*pixel_, place_.first_column ? nullptr : &left_, place_.first_line ? nullptr : &above,
        place_.first_column || place_.first_line ? nullptr : &above_left_};
    const bool neighbour = (place_.first_column && place_.x != 0 && weights_[1] + weights_[3] > 0) ||
                           (place_.first_line && place_.y != 0 && weights_[2] + weights_[3] > 0);
    if (!neighbour) filter(support, emit);
    left_ = *pixel_;
    above_left_ = above;
    line_[place_.x] = *pixel_;
  }
  /// nullptr: a pixel that is outside.
  template <class Emit>
  void filter(const std::array<const Pixel*, 4>& support, Emit& emit) const {
    const Pixel* nearest = nullptr;
    std::array<std::int64_t, 3> totals{};
    std::int64_t samples = 0;
    for (std::size_t n = 0; n < support.size(); ++n) {
      const Pixel* pixel = support[n];
      samples += weights_[n] * subpixels_;
      for (std::size_t i = 0; i < channels_; ++i)
        totals[i] += weights_[n] * (pixel ? pixel->sums[i] : subpixels_ * behind(i));
      if (pixel && pixel->object && weights_[n] > 0 && (!nearest || pixel->z < nearest->z)) nearest = pixel;
    }
    if (!nearest) return;
    // The sums contain half a step, unless the colours have no fraction.
    const std::int64_t half = c_half > 0 ? 0 : samples / 2;
    const auto colour = [&](std::size_t channel) {
      const std::int64_t total = totals[channel < channels_ ? channel : 0];
      return static_cast<std::uint8_t>((total + half) / samples >> c_fraction);
    };
    emit(Fragment{.triangle = nearest->triangle,
                  .z = nearest->z,
                  .y = static_cast<std::uint16_t>(place_.y),
                  .x = static_cast<std::uint16_t>(place_.x),
                  .red = colour(0),
                  .green = colour(1),
                  .blue = colour(2)});
  }

  std::size_t channels_;
  std::int64_t subpixels_;
  Background background_;
  FilterWeights weights_;
  std::optional<Pixel> pixel_;  ///< of the last head in this strip
  Place place_;
  std::int64_t covered_ = 0;  ///< subpixels of that pixel
  Pixel left_, above_left_;
  std::vector<Pixel> line_;  ///< the last pixel of each column
};

}  // namespace halfway::golden

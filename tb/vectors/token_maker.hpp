// SPDX-License-Identifier: Apache-2.0
// Random tokens of the shading processors.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "golden/shading_token.hpp"
#include "vectors/pipeline.hpp"
#include "vectors/random.hpp"

namespace halfway::vectors {

/// Tokens like those of a scene: directions are close to one direction, which changes from time to time, so
/// that cosines are mostly between 0 and 1. Some tokens are random words.
template <class Preset>
class TokenMaker {
 public:
  using Token = golden::ShadingToken<Preset>;

  TokenMaker(const words::ProcessorsConfig& config, std::uint64_t seed) : config_(config), random_(seed) {
    turn();
  }

  /// Most tokens are for light `light`.
  Token token(int light) {
    if (random_.one_in(40)) turn();
    const auto number = static_cast<std::uint32_t>(random_.one_in(12)  ? random_.word(Preset::c_light_bits)
                                                   : random_.one_in(4) ? random_.between(0, config_.lights())
                                                                       : std::int64_t{light});
    const int choice = static_cast<int>(random_.between(0, 31));
    if (choice == 0) return load(words::Command::remove, number);
    if (choice <= 2) return load(words::Command::redefine, number);
    if (choice <= 4) return load(words::Command::define, number);
    if (choice == 5 && random_.one_in(3)) return load(words::Command::new_frame, number);
    if (choice <= 7) return head();
    // Hardware without shadows passes shadow polygons on.
    if (choice <= (config_.shadows ? 16 : 8)) return shadow(number);
    return object();
  }
  Token load(words::Command command, std::uint32_t light) {
    Token token;
    token.command = command;
    token.light_number = light;
    auto& to = token.light;
    to.positional = !random_.one_in(4);
    to.spot = !random_.one_in(4);
    if constexpr (Preset::c_light_shift_bits > 0)
      if (random_.one_in(4)) to.shift = static_cast<std::uint32_t>(random_.bits(Preset::c_light_shift_bits));
    to.outer = static_cast<std::int64_t>(one_direction() * 0.1 * static_cast<double>(random_.between(-3, 9)));
    to.slope = static_cast<std::uint32_t>(random_.one_in(4) ? random_.word(Preset::c_spot_slope_bits)
                                                            : random_.between(64, 640));
    to.around_eye = random_.one_in(8)   ? static_cast<int>(random_.between(-512, 511))
                    : random_.one_in(4) ? 1
                                        : 0;
    to.place = near(Preset::c_light_place_fraction_bits, Preset::c_light_place_bits, 0.9);
    to.axis = near(Preset::c_direction_fraction_bits, Preset::c_direction_bits, 1);
    for (std::int64_t& axis : to.axis) axis = -axis - (axis == least(Preset::c_direction_bits) ? 1 : 0);
    to.half = near(Preset::c_direction_fraction_bits, Preset::c_direction_bits, 1);
    for (std::uint32_t& intensity : to.intensity)
      intensity = static_cast<std::uint32_t>(random_.word(Preset::c_light_intensity_bits));
    return token;
  }
  Token shadow(std::uint32_t light) {
    Token token = at_pixel();
    token.command = words::Command::shadow;
    token.light_number = light;
    token.opens = random_.one_in(2);
    return token;
  }
  Token head() {
    Token token = at_pixel();
    token.command = random_.one_in(4) ? words::Command::new_scanline : words::Command::new_pixel;
    return token;
  }
  Token object() {
    Token token = at_pixel();
    token.normalize = !random_.one_in(3);
    token.normal = near(Preset::c_vector_fraction_bits, Preset::c_vector_bits, 1);
    token.place = near(Preset::c_vector_fraction_bits, Preset::c_vector_bits, random_.one_in(2) ? -0.6 : 0.3);
    if (!random_.one_in(8))
      token.distance = static_cast<std::int64_t>(random_.bits(Preset::c_vector_fraction_bits));
    token.view = near(Preset::c_direction_fraction_bits, Preset::c_direction_bits, 1);
    if (random_.one_in(2))
      token.exponent = static_cast<std::uint32_t>(random_.word(Preset::c_exponent_bits));
    else
      token.exponent =
          static_cast<std::uint32_t>(random_.between(1, 100) << Preset::c_exponent_fraction_bits);
    for (golden::Channels* k : {&token.ambient, &token.diffuse, &token.specular})
      for (std::uint32_t& channel : *k)
        channel = static_cast<std::uint32_t>(
            random_.word(Preset::c_coefficient_bits - (random_.one_in(3) ? 0 : 3)));
    for (std::uint32_t& channel : token.radiance)
      channel = static_cast<std::uint32_t>(random_.word(Preset::c_radiance_bits));
    return token;
  }
  /// After the ambient processor N is a direction. Some tokens have random words there, as after a processor
  /// without normalization.
  Token behind_ambient(Token token) {
    if (token.is_object() && !random_.one_in(10))
      token.normal = near(Preset::c_direction_fraction_bits, Preset::c_direction_bits, 1);
    return token;
  }
  std::vector<std::uint32_t> words(const Token& token, int bits) {
    std::vector<std::uint32_t> flat(static_cast<std::size_t>(bits + 31) / 32);
    random_.fill(flat);
    token.encode(config_, flat);
    return flat;
  }
  Random& random() { return random_; }

 private:
  static constexpr std::int64_t least(int bits) { return -(std::int64_t{1} << (bits - 1)); }
  static constexpr double one_direction() {
    return static_cast<double>(std::int64_t{1} << Preset::c_direction_fraction_bits);
  }

  double unit() { return static_cast<double>(random_.between(-1000, 1000)) / 1000; }
  void turn() {
    double length = 0;
    do {
      for (double& axis : base_) axis = unit();
      length = std::sqrt(base_[0] * base_[0] + base_[1] * base_[1] + base_[2] * base_[2]);
    } while (length < 0.1);
    for (double& axis : base_) axis /= length;
  }
  /// A vector of approximately `length` near the base, or random words.
  golden::Axes near(int fraction_bits, int bits, double length) {
    golden::Axes words;
    const double spread = random_.one_in(3) ? 0.02 : 0.4;
    const double scale =
        random_.one_in(4) ? std::ldexp(length, -static_cast<int>(random_.between(0, 9))) : length;
    const bool any = random_.one_in(12);
    for (std::size_t i = 0; i < words.size(); ++i) {
      const double component = std::ldexp((base_[i] + spread * unit()) * scale, fraction_bits);
      const std::uint64_t word =
          any ? random_.word(bits) : static_cast<std::uint64_t>(static_cast<std::int64_t>(component));
      words[i] = static_cast<std::int64_t>(word << (64 - bits)) >> (64 - bits);
    }
    return words;
  }
  Token at_pixel() {
    Token token;
    token.triangle = static_cast<std::uint32_t>(random_.bits(32));
    token.y = static_cast<std::uint32_t>(random_.bits(Preset::c_pixel_y_bits));
    token.x = static_cast<std::uint32_t>(random_.bits(Preset::c_pixel_x_bits));
    token.z = static_cast<std::uint32_t>(random_.bits(Preset::c_depth_bits));
    token.light_number = static_cast<std::uint32_t>(random_.bits(Preset::c_light_bits));
    return token;
  }

  words::ProcessorsConfig config_;
  Random random_;
  std::array<double, 3> base_{};
};

/// The words of a light: those of the token that defines it, without the header.
template <class Preset>
Flat light_words(TokenMaker<Preset>& maker, const words::ProcessorsConfig& config,
                 const golden::ShadingLight& light) {
  using Layout = words::ProcessorsLayout<Preset>;
  golden::ShadingToken<Preset> token;
  token.command = words::Command::define;
  token.light = light;
  const int bits = Layout(config).token_bits();
  const auto words = maker.words(token, bits);
  Flat all;
  const int first = Layout::light_axes_low();
  const int last = Layout::light_colour_low(config.channels);
  for (int low = first; low < last; low += 16) {
    const int width = std::min(16, last - low);
    all.add(words::get_bits(words, {"", low, width, false, 0}), width);
  }
  return all;
}

}  // namespace halfway::vectors

// SPDX-License-Identifier: Apache-2.0
// Twin of rtl/illumination/shading_processor.vhd and unrolled_shading_processor.vhd, which give the same
// results: one term of the illumination model, I_out = I_in + k I (N.A)^x, token by token.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>

#include "golden/power.hpp"
#include "golden/shading_token.hpp"
#include "golden/shadow_counter.hpp"
#include "golden/spot_cone.hpp"
#include "golden/unit_vector.hpp"

namespace halfway::golden {

/// Kinds of processors: which term one adds.
enum class Term { ambient = 0, diffuse = 1, specular = 2 };

template <class Preset>
class ShadingProcessor {
 public:
  using Token = ShadingToken<Preset>;

  /// `light`: the number of its light; 0 is the ambient one's.
  ShadingProcessor(const ProcessorsConfig& config, Term term, int light)
      : config_(config),
        layout_(config),
        term_(term),
        number_(static_cast<std::uint32_t>(light)),
        positional_(light > config.directional),
        spots_(light > config.directional + config.positional) {
    if (config.shadows && term != Term::ambient) counter_.emplace();
  }

  /// Makes of `token` what leaves the processor.
  void process(Token& token) {
    const bool mine = token.light_number == number_;
    switch (token.command) {
      case Command::new_frame:
        if (counter_) counter_->clear();
        return;
      case Command::define:
        if (mine) define(token.light);
        return;
      case Command::redefine:
        if (mine && valid_) define(token.light);
        return;
      case Command::remove:
        if (mine) valid_ = false;
        return;
      case Command::shadow:
        if (mine && counter_) counter_->count(token.x, token.opens);
        return;
      default:
        shade(token);
    }
  }
  /// The same on a token's flat words.
  void process(std::span<std::uint32_t> words) {
    Token token = Token::decode(config_, words);
    process(token);
    if (token.is_object()) token.encode(config_, words);
  }

  /// A count of shadow volumes left its format, since the beginning.
  bool fault() const { return counter_ && counter_->fault(); }

 private:
  static constexpr bool c_exact = ProcessorsLayout<Preset>::c_exact;
  static constexpr std::uint32_t c_one = 1U << Preset::c_weight_fraction_bits;
  using Direction = Word<Preset::c_direction_bits>;
  using Offset = Word<Preset::c_offset_bits>;

  template <class W>
  static constexpr std::int64_t wrapped(std::int64_t value) {
    return W::from_bits(static_cast<std::uint64_t>(value)).value();
  }

  void define(const ShadingLight& light) {
    light_ = light;
    valid_ = true;
  }

  void shade(Token& token) {
    if (term_ == Term::ambient) {
      ready_vectors(token);
      if (valid_) add(token, token.ambient, c_one);
      return;
    }
    const bool reached = !counter_ || counter_->take(token.x, light_.around_eye);
    if (!valid_ || !reached) return;
    Axes normal;
    for (std::size_t i = 0; i < c_axes; ++i) normal[i] = wrapped<Direction>(token.normal[i]);
    if (term_ == Term::diffuse) {
      const Axes to_light = light_direction(token);
      const std::uint32_t cosine = golden::cosine<Preset>(dot_product(normal, to_light));
      constexpr int c_drop = Preset::c_direction_fraction_bits - Preset::c_weight_fraction_bits;
      add(token, token.diffuse, coned(static_cast<std::uint32_t>(round_half_up(cosine, c_drop)), to_light));
    } else {
      shade_highlight(token, normal);
    }
  }

  void shade_highlight(Token& token, const Axes& normal) {
    Axes to_light{}, half{};
    if constexpr (c_exact) {
      to_light = light_direction(token);
      // No highlight behind the horizon.
      if (!positive(dot_product(normal, to_light))) return;
      for (std::size_t i = 0; i < c_axes; ++i) half[i] = to_light[i] + token.view[i];
      half = normalized<Preset, Preset::c_direction_bits + 1>(half);
    } else {
      half = light_.half;
      if (spotted()) to_light = light_direction(token);
      if (at_place()) {
        for (std::size_t i = 0; i < c_axes; ++i)
          half[i] = wrapped<Offset>(half[i] + light_.place[i] - token.place[i]);
        half = normalized<Preset, Preset::c_offset_bits>(half);
      }
    }
    const std::uint32_t cosine = golden::cosine<Preset>(dot_product(normal, half));
    add(token, token.specular, coned(Power<Preset>::power(cosine, token.exponent), to_light));
  }

  bool at_place() const { return positional_ && light_.positional; }
  bool spotted() const { return spots_ && light_.spot; }

  /// N, and the view vector where there is one.
  void ready_vectors(Token& token) const {
    if (config_.normalize && token.normalize) {
      token.normal = normalized<Preset, Preset::c_vector_bits>(token.normal);
    } else {
      constexpr int c_drop = Preset::c_vector_fraction_bits - Preset::c_direction_fraction_bits;
      for (std::int64_t& n : token.normal) n = wrapped<Direction>(round_half_up(n, c_drop));
    }
    if (!layout_.has_view()) return;
    Axes to_eye;
    for (std::size_t i = 0; i < c_axes; ++i)
      to_eye[i] = wrapped<Word<Preset::c_vector_bits>>(-token.place[i]);
    token.view = normalized<Preset, Preset::c_vector_bits>(to_eye);
  }

  /// L
  Axes light_direction(const Token& token) const {
    Axes to_light;
    if (!at_place()) {
      constexpr int c_drop = Preset::c_light_place_fraction_bits - Preset::c_direction_fraction_bits;
      for (std::size_t i = 0; i < c_axes; ++i) to_light[i] = light_.place[i] >> c_drop;
      return to_light;
    }
    for (std::size_t i = 0; i < c_axes; ++i) {
      std::int64_t place = light_.place[i];
      if constexpr (c_exact) {
        constexpr int c_drop = Preset::c_light_place_fraction_bits + Preset::c_vector_fraction_bits -
                               Preset::c_offset_fraction_bits;
        place = round_half_up(place * token.distance, c_drop);
      }
      to_light[i] = wrapped<Offset>(place - (token.place[i] >> light_.shift));
    }
    return normalized<Preset, Preset::c_offset_bits>(to_light);
  }

  /// `weight` within the spot's cone.
  std::uint32_t coned(std::uint32_t weight, const Axes& to_light) const {
    if (!spotted()) return weight;
    const std::uint32_t factor =
        SpotCone<Preset>::factor(dot_product(to_light, light_.axis), light_.outer, light_.slope);
    return static_cast<std::uint32_t>(std::uint64_t{weight} * factor >> Preset::c_weight_fraction_bits);
  }

  /// I_out = I_in + k I weight
  void add(Token& token, const Channels& k, std::uint32_t weight) const {
    constexpr std::uint64_t c_brightest = low_bits(~std::uint64_t{0}, Preset::c_radiance_bits),
                            c_reflected = low_bits(~std::uint64_t{0}, Preset::c_reflected_bits);
    constexpr int c_product = Preset::c_coefficient_fraction_bits + Preset::c_light_intensity_fraction_bits -
                              Preset::c_reflected_fraction_bits;
    constexpr int c_term =
        Preset::c_reflected_fraction_bits + Preset::c_weight_fraction_bits - Preset::c_radiance_fraction_bits;
    for (std::size_t c = 0; c < static_cast<std::size_t>(config_.channels); ++c) {
      const std::int64_t product = std::int64_t{k[c]} * light_.intensity[c];
      const auto reflected =
          std::min(static_cast<std::uint64_t>(round_half_up(product, c_product)), c_reflected);
      token.radiance[c] = static_cast<std::uint32_t>(
          std::min(token.radiance[c] + (reflected * weight >> c_term), c_brightest));
    }
  }

  ProcessorsConfig config_;
  ProcessorsLayout<Preset> layout_;
  Term term_;
  std::uint32_t number_;
  bool positional_, spots_;  ///< its light can be positional, a spot
  bool valid_ = false;
  ShadingLight light_;
  std::optional<ShadowCounter> counter_;
};

}  // namespace halfway::golden

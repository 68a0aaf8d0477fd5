// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/illumination/light_term.vhd: the diffuse or the specular term of one light.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "golden/ambient_term.hpp"
#include "golden/cosine_power.hpp"
#include "golden/half_vector.hpp"
#include "golden/light_vector.hpp"
#include "golden/light_weight.hpp"
#include "golden/shading_token.hpp"

namespace halfway::golden {

template <class Preset>
class LightTerm {
 public:
  using Token = ShadingToken<Preset>;

  /// The number of the light determines whether it can be positional or a spot.
  LightTerm(const ProcessorsConfig& config, Term term, int light)
      : config_(config),
        term_(term),
        positional_(light > config.directional),
        spots_(light > config.directional + config.positional) {}

  /// k I (N.A)^x. In preset exact there is no highlight if the light is not above the horizon.
  std::optional<Terms> terms(const Token& token, const ShadingLight& light) const {
    const bool diffuse = term_ == Term::diffuse;
    const Axes normal = direction(token), l = to_light(token, light);
    if (c_exact && !diffuse && !positive(dot_product(normal, l))) return std::nullopt;
    std::uint32_t weight = diffuse ? cosine_weight<Preset>(normal, l)
                                   : cosine_power<Preset>(normal, half(token, light, l), token.exponent);
    if (spots_ && light.spot) weight = light_weight<Preset>(weight, l, light.axis, light.outer, light.slope);
    Terms terms{};
    for (std::size_t c = 0; c < static_cast<std::size_t>(config_.channels); ++c) {
      const std::uint32_t k = diffuse ? token.diffuse[c] : token.specular[c];
      terms[c] = reflected_term<Preset>(k, light.intensity[c], weight);
    }
    return terms;
  }

 private:
  static constexpr bool c_exact = ProcessorsLayout<Preset>::c_exact;

  bool at_place(const ShadingLight& light) const { return positional_ && light.positional; }

  /// N as output by the ambient processor.
  static Axes direction(const Token& token) {
    Axes normal;
    for (std::size_t i = 0; i < normal.size(); ++i)
      normal[i] =
          Word<Preset::c_direction_bits>::from_bits(static_cast<std::uint64_t>(token.normal[i])).value();
    return normal;
  }
  /// L
  Axes to_light(const Token& token, const ShadingLight& light) const {
    return light_vector<Preset>(at_place(light), light.place, light.shift, token.place, token.distance);
  }
  /// H
  Axes half(const Token& token, const ShadingLight& light, const Axes& l) const {
    if constexpr (c_exact) return half_vector<Preset>(l, token.view);
    if (!at_place(light)) return light.half;
    return half_vector<Preset>(light_offset<Preset>(light.place, light.shift, token.place, token.distance),
                               light.half);
  }

  ProcessorsConfig config_;
  Term term_;
  bool positional_, spots_;
};

}  // namespace halfway::golden

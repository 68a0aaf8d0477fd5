// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/illumination/ambient_term.vhd.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "golden/reflected_term.hpp"
#include "golden/shading_token.hpp"
#include "golden/unit_vector.hpp"

namespace halfway::golden {

/// Terms of a token: red, green, blue; or one channel.
using Terms = std::array<std::uint64_t, 3>;

template <class Preset>
class AmbientTerm {
 public:
  using Token = ShadingToken<Preset>;

  explicit AmbientTerm(const ProcessorsConfig& config) : config_(config), layout_(config) {}

  /// k_a I_a
  Terms terms(const Token& token, const ShadingLight& light) const {
    Terms terms{};
    for (std::size_t c = 0; c < static_cast<std::size_t>(config_.channels); ++c)
      terms[c] = reflected_term<Preset>(token.ambient[c], light.intensity[c], c_full_weight<Preset>);
    return terms;
  }
  /// Normalizes N, and the view vector if there is one.
  void ready_vectors(Token& token) const {
    if (config_.normalize && token.normalize) {
      token.normal = normalized<Preset, Preset::c_vector_bits>(token.normal);
    } else {
      constexpr int c_drop = Preset::c_vector_fraction_bits - Preset::c_direction_fraction_bits;
      for (std::int64_t& n : token.normal) n = wrapped<Preset::c_direction_bits>(round_half_up(n, c_drop));
    }
    if (!layout_.has_view()) return;
    Axes to_eye;
    for (std::size_t i = 0; i < to_eye.size(); ++i)
      to_eye[i] = wrapped<Preset::c_vector_bits>(-token.place[i]);
    token.view = normalized<Preset, Preset::c_vector_bits>(to_eye);
  }

 private:
  template <int Bits>
  static constexpr std::int64_t wrapped(std::int64_t value) {
    return Word<Bits>::from_bits(static_cast<std::uint64_t>(value)).value();
  }

  ProcessorsConfig config_;
  ProcessorsLayout<Preset> layout_;
};

}  // namespace halfway::golden

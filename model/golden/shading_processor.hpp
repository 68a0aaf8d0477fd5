// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/illumination/shading_processor.vhd and unrolled_shading_processor.vhd, which have equal
// results: one term of the illumination model, I_out = I_in + k I (N.A)^x, token by token.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "golden/ambient_term.hpp"
#include "golden/light_state.hpp"
#include "golden/light_term.hpp"
#include "golden/radiance_sum.hpp"
#include "golden/shading_token.hpp"

namespace halfway::golden {

template <class Preset>
class ShadingProcessor {
 public:
  using Token = ShadingToken<Preset>;

  /// `light`: number of the light; 0 for the ambient processor.
  ShadingProcessor(const ProcessorsConfig& config, Term term, int light)
      : config_(config),
        term_(term),
        state_(config.shadows && term != Term::ambient, static_cast<std::uint32_t>(light)),
        ambient_term_(config),
        light_term_(config, term, light) {}

  /// Changes `token` to the processor's output.
  void process(Token& token) {
    if (!token.is_object()) {
      state_.take(token);
      return;
    }
    if (term_ == Term::ambient) {
      ambient_term_.ready_vectors(token);
      token.radiance.fill(Token::c_first_radiance);
    }
    if (!state_.defined() || !state_.lit()) return;
    if (term_ == Term::ambient)
      add(token, ambient_term_.terms(token, state_.light()));
    else if (const auto terms = light_term_.terms(token, state_.light()))
      add(token, *terms);
  }
  /// The same on the flat words of a token.
  void process(std::span<std::uint32_t> words) {
    Token token = Token::decode(config_, words);
    process(token);
    if (token.is_object()) token.encode(config_, words);
  }

 private:
  void add(Token& token, const Terms& terms) const {
    for (std::size_t c = 0; c < static_cast<std::size_t>(config_.channels); ++c)
      token.radiance[c] = radiance_sum<Preset>(token.radiance[c], terms[c]);
  }

  ProcessorsConfig config_;
  Term term_;
  LightState<Preset> state_;
  AmbientTerm<Preset> ambient_term_;
  LightTerm<Preset> light_term_;
};

}  // namespace halfway::golden

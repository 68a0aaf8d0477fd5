// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/shaders/shading_pipeline.vhd: the ambient processor, then the processors of light 1, of
// light 2 and so on. Tokens pass all of them in order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "golden/shading_processor.hpp"

namespace halfway::golden {

template <class Preset>
class ShadingPipeline {
 public:
  using Token = ShadingToken<Preset>;

  explicit ShadingPipeline(const ProcessorsConfig& config)
      : lights_(static_cast<std::uint32_t>(config.lights())) {
    processors_.reserve(static_cast<std::size_t>(config.processors()));
    processors_.emplace_back(config, Term::ambient, 0);
    for (int light = 1; light <= config.lights(); ++light) {
      if (config.diffuse) processors_.emplace_back(config, Term::diffuse, light);
      if (config.specular) processors_.emplace_back(config, Term::specular, light);
    }
  }

  /// Changes `token` to the output of the last processor. Returns true if there is an output: only objects
  /// have one. Calls watch(index, token) after each processor.
  template <class Watch>
  bool process(Token& token, Watch&& watch) {
    if (token.is_for_light() && token.light_number > lights_) fault_ = true;
    for (std::size_t i = 0; i < processors_.size(); ++i) {
      processors_[i].process(token);
      watch(i, token);
    }
    return token.is_object();
  }
  bool process(Token& token) {
    return process(token, [](std::size_t, const Token&) {});
  }

  /// True since a token for a light that does not exist.
  bool fault() const { return fault_; }

 private:
  std::uint32_t lights_;
  bool fault_ = false;
  std::vector<ShadingProcessor<Preset>> processors_;
};

}  // namespace halfway::golden

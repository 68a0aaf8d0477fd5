// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/illumination/light_state.vhd: a processor's state between tokens.
#pragma once

#include <cstdint>
#include <optional>

#include "golden/shading_token.hpp"
#include "golden/shadow_counter.hpp"

namespace halfway::golden {

template <class Preset>
class LightState {
 public:
  /// `shadows`: count the shadow volumes of light `number`.
  LightState(bool shadows, std::uint32_t number) : number_(number) {
    if (shadows) counter_.emplace();
  }

  /// Processes a token that is not an object.
  void take(const ShadingToken<Preset>& token) {
    const bool own = token.light_number == number_;
    switch (token.command) {
      case Command::new_frame:
        if (counter_) counter_->clear();
        return;
      case Command::define:
        if (own) define(token.light);
        return;
      case Command::redefine:
        if (own && defined_) define(token.light);
        return;
      case Command::remove:
        if (own) defined_ = false;
        return;
      case Command::shadow:
        if (own && counter_) counter_->count(token.x, token.opens);
        return;
      default:
        return;
    }
  }
  /// Processes an object. Returns true if no shadow volume contains it. Resets the counter of its column.
  bool take_object(const ShadingToken<Preset>& token) {
    return !counter_ || counter_->take(token.x, light_.around_eye);
  }

  bool defined() const { return defined_; }
  const ShadingLight& light() const { return light_; }
  /// True if a count of shadow volumes has exceeded its format since the start.
  bool fault() const { return counter_ && counter_->fault(); }

 private:
  void define(const ShadingLight& light) {
    light_ = light;
    defined_ = true;
  }

  std::uint32_t number_;
  bool defined_ = false;
  ShadingLight light_;
  std::optional<ShadowCounter> counter_;
};

}  // namespace halfway::golden

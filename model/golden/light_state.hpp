// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/illumination/light_state.vhd: a processor's state between tokens.
#pragma once

#include <cstdint>

#include "golden/shading_token.hpp"

namespace halfway::golden {

template <class Preset>
class LightState {
 public:
  /// `shadows`: count the shadow volumes of light `number`.
  LightState(bool shadows, std::uint32_t number) : number_(number), shadows_(shadows) {}

  /// Processes a token that is not an object.
  void take(const ShadingToken<Preset>& token) {
    const bool own = token.light_number == number_;
    switch (token.command) {
      case Command::new_frame:
      case Command::new_scanline:
      case Command::new_pixel:
        count_ = {};
        return;
      case Command::define:
        if (own) define(token.light);
        return;
      case Command::redefine:
        if (own && defined_) define(token.light);
        return;
      case Command::remove:
        if (own) count_ = {}, defined_ = false;
        return;
      case Command::shadow:
        if (own) count_ += Count::from_bits(token.opens ? 1 : ~std::uint64_t{0});
        return;
      case Command::new_object:
        return;
    }
  }
  /// True if no shadow volume contains the objects that follow. A negative number of volumes counts as none:
  /// the rounding of depths may place the exit of a thin volume before its entry.
  bool lit() const { return !shadows_ || light_.around_eye + count_.value() <= 0; }

  bool defined() const { return defined_; }
  const ShadingLight& light() const { return light_; }

 private:
  using Count = Word<Exact::c_shadow_count_bits>;

  void define(const ShadingLight& light) {
    light_ = light;
    defined_ = true;
    count_ = {};
  }

  std::uint32_t number_;
  bool shadows_, defined_ = false;
  ShadingLight light_;
  Count count_;  ///< volumes opened at this pixel minus those closed
};

}  // namespace halfway::golden

// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/shaders/fragment_output.vhd: converts a shaded object to a fragment.
#pragma once

#include <cstddef>
#include <cstdint>

#include "frame/fragment.hpp"
#include "golden/saturate.hpp"
#include "golden/shading_token.hpp"

namespace halfway::golden {

/// With one channel (grey) all colours are equal.
template <class Preset>
Fragment fragment_output(const ShadingToken<Preset>& token, int channels) {
  const auto colour = [&](std::size_t channel) {
    constexpr int c_bits = Preset::c_radiance_bits + 2;
    return static_cast<std::uint8_t>(
        saturate<c_bits, Preset::c_radiance_fraction_bits, Preset::c_colour_bits>(
            Word<c_bits>::from_bits(token.radiance[channels == 3 ? channel : 0])));
  };
  return {.triangle = token.triangle,
          .z = token.z,
          .y = static_cast<std::uint16_t>(token.y),
          .x = static_cast<std::uint16_t>(token.x),
          .red = colour(0),
          .green = colour(1),
          .blue = colour(2)};
}

}  // namespace halfway::golden

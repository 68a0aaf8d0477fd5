// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/shaders/quadratic_pkg.vhd: positions of the channels' blocks in an init vector.
#pragma once

#include "words/formats.hpp"

namespace halfway::words {

/// Degree 2: quadratics. Degree 1: planes, as in Gouraud's shading; a channel then has only the lower words
/// of its block, because the second differences are zero.
template <class Preset, int Degree>
struct QuadraticLayout {
  static_assert(Degree == 1 || Degree == 2);

  static constexpr int c_channel_bits =
      Degree == 1 ? Preset::init_channel_at::dxx.low : Preset::c_init_channel_bits;
  static constexpr int channel_low(int channel) {
    return Preset::c_init_header_bits + channel * c_channel_bits;
  }
  static constexpr int init_bits(int channels) { return channel_low(channels); }
  /// The block's field is a word of this degree.
  static constexpr bool has(const Field& field) { return field.low < c_channel_bits; }
};

}  // namespace halfway::words

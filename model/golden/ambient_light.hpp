// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/shaders/ambient_light.vhd: the terms of the current span.
#pragma once

#include <cstddef>
#include <span>

#include "golden/colour_sum.hpp"
#include "golden/words.hpp"

namespace halfway::golden {

template <class Preset>
class AmbientLight {
 public:
  AmbientLight(int channels, int data_bits) : channels_(channels), data_bits_(data_bits) {}

  /// `low`: lowest bit of the ambient light in the header.
  void span_load(std::span<const std::uint32_t> header, int low) {
    for (int c = 0; c < channels_; ++c)
      terms_[static_cast<std::size_t>(c)] =
          get_bits(header, Preset::ambient_channel_at::ambient, low + c * Preset::c_ambient_channel_bits)
          << data_bits_;
  }

  const ColourTerms& terms() const { return terms_; }

 private:
  int channels_, data_bits_;
  ColourTerms terms_{};
};

}  // namespace halfway::golden

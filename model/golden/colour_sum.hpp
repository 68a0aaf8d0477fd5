// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/shaders/colour_sum.vhd.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "golden/saturating_sum.hpp"

namespace halfway::golden {

/// A term of each channel. Without colour (one channel) only the first one is used.
using ColourTerms = std::array<std::uint64_t, 3>;

/// Red, green, blue.
using Colours = std::array<std::uint8_t, 3>;

/// The sums of all terms of each channel.
template <class Preset>
class ColourSum {
 public:
  /// `data_bits`: of a light's sample. A term has this number of fraction bits more than a factor.
  ColourSum(int channels, int data_bits) : channels_(channels), data_bits_(data_bits) {}

  void add(const ColourTerms& terms) {
    for (std::size_t c = 0; c < terms.size(); ++c) sums_[c].add(terms[c]);
  }
  /// With one channel all colours are equal.
  Colours colours() const {
    const std::uint8_t first = colour(0);
    if (channels_ == 1) return {first, first, first};
    return {first, colour(1), colour(2)};
  }

 private:
  std::uint8_t colour(std::size_t channel) const {
    return static_cast<std::uint8_t>(
        sums_[channel].result(Preset::c_factor_fraction_bits + data_bits_, Preset::c_colour_bits));
  }

  int channels_, data_bits_;
  std::array<SaturatingSum, 3> sums_;
};

}  // namespace halfway::golden

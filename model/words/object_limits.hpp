// SPDX-License-Identifier: Apache-2.0
// Subpixels, strips and filter of the object processors, as in rtl/objects/objects_pkg.vhd and
// filter_pkg.vhd.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "words/formats.hpp"

namespace halfway::words {

/// Subpixels per row and per column of a pixel with 1, 4 or 16.
constexpr int side_of(int subpixels) {
  return subpixels == 16 ? 4 : subpixels == 4 ? 2 : 1;
}

/// Pixels with several subpixels are filtered.
constexpr bool has_filter(int subpixels) {
  return subpixels > 1;
}

/// Limits of a strip, in pixels: the ends of spans must fit span_x in subpixels, and the first lines of
/// triangles pixel_y.
template <class Preset>
constexpr int most_columns(int subpixels) {
  return std::min(((1 << (Exact::c_span_x_bits - 1)) - 1) / side_of(subpixels), 1 << Preset::c_pixel_x_bits);
}
template <class Preset>
constexpr int most_lines(int subpixels) {
  return (1 << Preset::c_pixel_y_bits) / side_of(subpixels);
}

/// Weights of a pixel itself, left, above, above left. Their sum is a power of two.
using FilterWeights = std::array<std::int64_t, 4>;
inline constexpr FilterWeights c_filter_weights = {1, 1, 1, 1};

}  // namespace halfway::words

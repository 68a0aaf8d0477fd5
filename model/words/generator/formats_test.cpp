// SPDX-License-Identifier: Apache-2.0
// The bounds are sufficient for the formats' use.
#include "words/generator/formats.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "words/formats.hpp"

namespace halfway::tables {
namespace {

double stated(const PresetFormats& preset, std::string_view name, std::string_view of = "") {
  const auto& bounds = format_of(preset, name).bounds;
  return std::ranges::find(bounds, of, &Bound::of)->value;
}

TEST(Formats, BoundsAreSufficientForTheUseOfTheFormats) {
  using words::Exact;
  const auto presets = preset_formats();
  const PresetFormats& exact = presets[0];
  // Control points are within 2 * 1023. Add half a step for rounding and the error of the differences.
  const double whole = std::ldexp(1.0, Exact::c_intensity_bits - 1 - Exact::c_intensity_fraction_bits);
  EXPECT_LT(2046 + 0.5 + stated(exact, "intensity"), whole);
  // The error of a colour is its rounding of half a step plus less than half a step.
  EXPECT_LT(stated(exact, "intensity") + stated(exact, "intensity", "samples"), 0.5);
  EXPECT_LT(stated(exact, "depth_sum"), 0.5);
  // Half a bell has 2^9 cells in preset exact's tables.
  EXPECT_LE(stated(exact, "angle"), 0.25 * std::ldexp(1.0, -9));
  // Exponent 10^6 with cos^16: the scale is 250. The angles of an arc are within three half bells before
  // scaling.
  EXPECT_LT(3.0 * 251, std::ldexp(1.0, Exact::c_angle_bits - 1 - Exact::c_angle_fraction_bits));
  // The largest factor times the least entry of 8 bits is white.
  EXPECT_GE((1 << Exact::c_factor_bits) - (1 << Exact::c_factor_fraction_bits),
            (255 << 8) << Exact::c_factor_fraction_bits);
  // The truncation errors of all processors' terms are much less than a colour step.
  EXPECT_LT(stated(exact, "radiance"), 0.01);
}

}  // namespace
}  // namespace halfway::tables

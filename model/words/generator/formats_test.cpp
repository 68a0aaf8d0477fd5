// SPDX-License-Identifier: Apache-2.0
// The layouts, and the bounds that are sufficient for the formats' use.
#include "words/generator/formats.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "words/formats.hpp"

namespace halfway::tables {
namespace {

// Checks the fields that the golden model uses: each layout has no gap and no overlap, and the width of its
// formats.
template <std::size_t Count>
void expect_layout(const PresetFormats& preset, const std::vector<Field>& fields,
                   const std::array<words::Field, Count>& compiled, int bits) {
  ASSERT_EQ(fields.size(), Count);
  int low = 0;
  for (std::size_t i = 0; i < Count; ++i) {
    const Format& format = format_of(preset, fields[i].format);
    EXPECT_EQ(compiled[i].name, fields[i].name);
    EXPECT_EQ(compiled[i].low, low) << fields[i].name;
    EXPECT_EQ(compiled[i].bits, format.bits()) << fields[i].name;
    EXPECT_EQ(compiled[i].is_signed, format.is_signed) << fields[i].name;
    EXPECT_EQ(compiled[i].fraction_bits, format.fraction_bits) << fields[i].name;
    low += format.bits();
  }
  EXPECT_EQ(low, bits);
}

template <class Preset>
void expect_preset(const PresetFormats& preset) {
  EXPECT_EQ(preset.name, Preset::c_name);
  ASSERT_EQ(preset.layouts.size(), 9u);
  const auto header = [&](std::size_t layout, const auto& compiled, int bits) {
    expect_layout(preset, preset.layouts[layout].header, compiled, bits);
  };
  const auto channel = [&](std::size_t layout, const auto& compiled, int bits) {
    expect_layout(preset, preset.layouts[layout].channel, compiled, bits);
  };
  header(0, Preset::c_init_header, Preset::c_init_header_bits);
  channel(0, Preset::c_init_channel, Preset::c_init_channel_bits);
  EXPECT_TRUE(preset.layouts[1].header.empty() && Preset::c_ambient_header_bits == 0);
  channel(1, Preset::c_ambient_channel, Preset::c_ambient_channel_bits);
  header(2, Preset::c_diffuse_header, Preset::c_diffuse_header_bits);
  channel(2, Preset::c_diffuse_channel, Preset::c_diffuse_channel_bits);
  header(3, Preset::c_specular_header, Preset::c_specular_header_bits);
  channel(3, Preset::c_specular_channel, Preset::c_specular_channel_bits);
  header(4, Preset::c_request_header, Preset::c_request_header_bits);
  header(5, Preset::c_plane_header, Preset::c_plane_header_bits);
  header(6, Preset::c_pixel_header, Preset::c_pixel_header_bits);
  for (const std::size_t layout : {4, 5, 6}) EXPECT_TRUE(preset.layouts[layout].channel.empty());
  header(7, Preset::c_light_axes_header, Preset::c_light_axes_header_bits);
  channel(7, Preset::c_light_axes_channel, Preset::c_light_axes_channel_bits);
  EXPECT_TRUE(preset.layouts[8].header.empty() && Preset::c_light_colour_header_bits == 0);
  channel(8, Preset::c_light_colour_channel, Preset::c_light_colour_channel_bits);
}

TEST(Formats, TheCompiledLayoutsHaveNeitherGapsNorOverlaps) {
  const auto presets = preset_formats();
  ASSERT_EQ(presets.size(), 2u);
  expect_preset<words::Exact>(presets[0]);
  expect_preset<words::Published>(presets[1]);
}

TEST(Formats, NamesAreUniqueAndTheSameInBothPresets) {
  const auto presets = preset_formats();
  std::vector<std::string_view> names[2];
  for (int p = 0; p < 2; ++p) {
    for (const Format& f : presets[p].formats) names[p].push_back(f.name);
    EXPECT_EQ(std::set(names[p].begin(), names[p].end()).size(), names[p].size());
  }
  EXPECT_EQ(names[0], names[1]);
}

TEST(Formats, AWrongFormatNameIsRefused) {
  auto presets = preset_formats();
  presets[0].layouts[0].header[0].format = "no such format";
  EXPECT_THROW(cpp_header(presets), std::logic_error);
}

double stated(const PresetFormats& preset, std::string_view name, std::string_view of = "") {
  const auto& bounds = format_of(preset, name).bounds;
  return std::ranges::find(bounds, of, &Bound::of)->value;
}

// Checks that the bounds are sufficient for the use of the formats.
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

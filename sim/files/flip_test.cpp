// SPDX-License-Identifier: Apache-2.0
#include "sim/files/flip.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "sim/os/must.hpp"

namespace halfway {
namespace {

using Colour = std::array<double, 3>;

Frame flat(FrameSize size, const Colour& colour) {
  Frame frame(size);
  for (std::size_t i = 0; i < frame.rgb.size(); ++i) frame.rgb[i] = static_cast<std::uint8_t>(colour[i % 3]);
  return frame;
}

// White right of column `edge`, black left of it.
Frame half_white(FrameSize size, std::uint32_t edge) {
  Frame frame(size);
  for (std::uint32_t y = 0; y < size.height; ++y)
    for (std::uint32_t x = edge; x < size.width; ++x)
      std::fill_n(&frame.rgb[frame.offset(x, y)], 3, std::uint8_t{255});
  return frame;
}

double flat_error(const Colour& a, const Colour& b) {
  return flat_flip_error({a[0], a[1], a[2]}, {b[0], b[1], b[2]});
}

TEST(Flip, EqualPicturesHaveNoError) {
  const Frame frame = half_white({40, 30}, 20);
  const auto errors = flip_errors(frame, frame);
  ASSERT_TRUE(errors);
  EXPECT_EQ(*std::ranges::max_element(*errors), 0.0);
}

TEST(Flip, FramesOfDifferentSizesAreRefused) {
  EXPECT_FALSE(flip_errors(Frame({4, 3}), Frame({3, 4})));
}

// The definition's two ends: green and blue have the largest error; the knee is at 0.95.
TEST(Flip, TheDefinitionFixesThreeErrors) {
  EXPECT_EQ(flip_error_of_distance(0), 0.0);
  EXPECT_NEAR(flat_error({0, 255, 0}, {0, 0, 255}), 1.0, 1e-12);
  // Black and white differ by 100 in lightness. 41.2 is the distance of green and blue to the power 0.7.
  EXPECT_NEAR(flat_error({0, 0, 0}, {255, 255, 255}), 0.967, 0.001);
}

TEST(Flip, FlatPatchesHaveTheErrorOfTheClosedForm) {
  constexpr FrameSize c_size{24, 24};
  // The feature part is the root of a difference that rounding leaves: 1e-8.
  for (const Colour& base :
       {Colour{16, 16, 16}, Colour{76, 76, 76}, Colour{128, 128, 128}, Colour{200, 200, 200},
        Colour{180, 40, 40}, Colour{40, 160, 60}, Colour{30, 60, 200}, Colour{200, 180, 20}}) {
    double before = 0;
    for (const double step : {1.0, 2.0, 4.0, 8.0, 16.0, 32.0}) {
      const Colour other{base[0] + step, base[1] + step, base[2] + step};
      const double expected = flat_error(base, other);
      const auto errors = flip_errors(flat(c_size, base), flat(c_size, other));
      ASSERT_TRUE(errors);
      for (const double error : *errors) ASSERT_NEAR(error, expected, 1e-7) << base[0] << " + " << step;
      EXPECT_GT(expected, before) << base[0] << " + " << step;
      before = expected;
    }
  }
}

TEST(Flip, EqualsTheDefinitionOnNoiseAndOutlines) {
  constexpr FrameSize c_size{32, 24};
  std::mt19937 random(7);
  Frame noise(c_size), other(c_size);
  for (std::uint8_t& byte : noise.rgb) byte = static_cast<std::uint8_t>(random());
  other.rgb = noise.rgb;
  for (std::size_t i = 0; i < other.rgb.size(); i += 7) other.rgb[i] = static_cast<std::uint8_t>(random());
  const Frame left = half_white(c_size, 15), right = half_white(c_size, 16);
  struct Case {
    const Frame &a, &b;
    std::array<double, 5> errors;
  };
  // By the paper's equations with kernels of two dimensions, without bands.
  for (const Case& c :
       {Case{noise, other, {0.281294379, 0.292246744, 0.191326652, 0.355299577, 0.208344283}},
        Case{left, right, {0.0, 0.497552566, 0.538173745, 0.0, 0.000000056}},
        Case{noise, left, {0.976228048, 0.936881240, 0.878392491, 0.964244208, 0.967786497}}}) {
    const auto errors = must(flip_errors(c.a, c.b));
    std::size_t i = 0;
    for (const auto& [x, y] : {std::pair{0U, 0U}, {16, 12}, {15, 3}, {31, 23}, {7, 20}})
      EXPECT_NEAR(errors[std::size_t{y} * c_size.width + x], c.errors[i++], 1e-6) << x << ',' << y;
  }
}

TEST(PerceivedPixels, CountsWhatDiffersByMoreThanOneUnitOfLightness) {
  constexpr FrameSize c_size{20, 10};
  const auto seen = [&](double a, double b) {
    return must(perceived_pixels(flat(c_size, {a, a, a}), flat(c_size, {b, b, b})));
  };
  for (const double grey : {16.0, 64.0, 128.0, 200.0}) {
    EXPECT_EQ(seen(grey, grey), 0U);
    EXPECT_EQ(seen(grey, grey + 1), 0U) << grey;
    EXPECT_EQ(seen(grey, grey + 4), 200U) << grey;
  }
  EXPECT_EQ(seen(76, 153), 200U);  // grey 0.3 and 0.6
}

}  // namespace
}  // namespace halfway

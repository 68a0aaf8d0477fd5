// SPDX-License-Identifier: Apache-2.0
#include "sim/pictures/flip.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "sim/pictures/perception.hpp"
#include "sim/system/must.hpp"

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

// The colour matrix and the curves, written again from the standards.
struct Lab {
  double l, a, b;
};

double curve(double t) {
  return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16) / 116;
}

std::array<double, 3> relative_xyz(const std::array<double, 3>& rgb) {
  const auto [r, g, b] = rgb;
  return {(0.41238656 * r + 0.35759149 * g + 0.18045049 * b) / 0.95042854,
          (0.21263682 * r + 0.71518298 * g + 0.07218020 * b) / 1.0,
          (0.01933062 * r + 0.11919716 * g + 0.95037259 * b) / 1.08890037};
}

double linear(double byte) {
  const double c = byte / 255;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

// The error by the equations of the paper, with kernels of two dimensions, at one pixel.
class Definition {
 public:
  explicit Definition(const Frame& frame) : frame_(frame) {}

  Lab filtered_lab(int x, int y) const {
    std::array<double, 3> opponent{};
    for (std::size_t channel = 0; channel < 3; ++channel) {
      double sum = 0, weights = 0;
      for (int j = -10; j <= 10; ++j)
        for (int i = -10; i <= 10; ++i) {
          const double weight = sensitivity(channel, i * i + j * j);
          weights += weight;
          sum += weight * opponent_at(x + i, y + j)[channel];
        }
      opponent[channel] = sum / weights;
    }
    // Solve the linear colour equations by Cramer's rule.
    const double fy = (opponent[0] + 16) / 116;
    const std::array<double, 3> xyz{(fy + opponent[1] / 500) * 0.95042854, fy,
                                    (fy - opponent[2] / 200) * 1.08890037};
    const std::array<std::array<double, 3>, 3> m{{{0.41238656, 0.35759149, 0.18045049},
                                                  {0.21263682, 0.71518298, 0.07218020},
                                                  {0.01933062, 0.11919716, 0.95037259}}};
    const auto det = [](const std::array<std::array<double, 3>, 3>& a) {
      return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
             a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
             a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
    };
    std::array<double, 3> rgb{};
    for (std::size_t column = 0; column < 3; ++column) {
      auto with = m;
      for (std::size_t row = 0; row < 3; ++row) with[row][column] = xyz[row];
      rgb[column] = std::clamp(det(with) / det(m), 0.0, 1.0);
    }
    const auto relative = relative_xyz(rgb);
    const double l = 116 * curve(relative[1]) - 16;
    return {l, l / 100 * 500 * (curve(relative[0]) - curve(relative[1])),
            l / 100 * 200 * (curve(relative[1]) - curve(relative[2]))};
  }

  // Magnitudes of the first and the second derivative of the achromatic channel.
  std::array<double, 2> features(int x, int y) const {
    const double deviation = 0.041 * c_pixels_per_degree;
    const auto kernel = [&](int order, double i, double j) {
      const double gaussian = std::exp(-(i * i + j * j) / (2 * deviation * deviation));
      return order == 1 ? -i * gaussian : (i * i / (deviation * deviation) - 1) * gaussian;
    };
    std::array<double, 2> magnitudes{};
    for (const int order : {1, 2}) {
      double positive = 0, negative = 0;
      for (int j = -9; j <= 9; ++j)
        for (int i = -9; i <= 9; ++i) {
          const double k = kernel(order, i, j);
          (k > 0 ? positive : negative) += k;
        }
      double dx = 0, dy = 0;
      for (int j = -9; j <= 9; ++j)
        for (int i = -9; i <= 9; ++i) {
          const double value = (opponent_at(x + i, y + j)[0] + 16) / 116;
          const double kx = kernel(order, i, j), ky = kernel(order, j, i);
          dx += value * kx / (kx > 0 ? positive : -negative);
          dy += value * ky / (ky > 0 ? positive : -negative);
        }
      magnitudes[static_cast<std::size_t>(order - 1)] = std::hypot(dx, dy);
    }
    return magnitudes;
  }

 private:
  static double sensitivity(std::size_t channel, double pixels_squared) {
    const double z = pixels_squared / (c_pixels_per_degree * c_pixels_per_degree);
    const auto term = [z](double a, double b) {
      return a * std::sqrt(std::numbers::pi / b) * std::exp(-std::numbers::pi * std::numbers::pi * z / b);
    };
    return channel == 0   ? term(1, 0.0047)
           : channel == 1 ? term(1, 0.0053)
                          : term(34.1, 0.04) + term(13.5, 0.025);
  }
  std::array<double, 3> opponent_at(int x, int y) const {
    const auto at = [](int v, std::uint32_t size) {
      return static_cast<std::uint32_t>(std::clamp(v, 0, static_cast<int>(size) - 1));
    };
    const std::size_t i = frame_.offset(at(x, frame_.size.width), at(y, frame_.size.height));
    const auto [xr, yr, zr] =
        relative_xyz({linear(frame_.rgb[i]), linear(frame_.rgb[i + 1]), linear(frame_.rgb[i + 2])});
    return {116 * yr - 16, 500 * (xr - yr), 200 * (yr - zr)};
  }
  const Frame& frame_;
};

double defined_error(const Frame& a, const Frame& b, int x, int y) {
  const Definition first(a), second(b);
  const Lab p = first.filtered_lab(x, y), q = second.filtered_lab(x, y);
  const double colour = flip_error_of_distance(std::abs(p.l - q.l) + std::hypot(p.a - q.a, p.b - q.b));
  const auto f = first.features(x, y), g = second.features(x, y);
  const double change = std::max(std::abs(f[0] - g[0]), std::abs(f[1] - g[1]));
  return std::pow(colour, 1 - std::sqrt(change / std::sqrt(2.0)));
}

TEST(Flip, EqualsTheDefinitionOnNoiseAndOutlines) {
  constexpr FrameSize c_size{32, 24};
  std::mt19937 random(7);
  Frame noise(c_size), other(c_size);
  for (std::uint8_t& byte : noise.rgb) byte = static_cast<std::uint8_t>(random());
  other.rgb = noise.rgb;
  for (std::size_t i = 0; i < other.rgb.size(); i += 7) other.rgb[i] = static_cast<std::uint8_t>(random());
  const Frame left = half_white(c_size, 15), right = half_white(c_size, 16);
  using Pair = std::pair<const Frame*, const Frame*>;
  for (const auto& [a, b] : {Pair{&noise, &other}, Pair{&left, &right}, Pair{&noise, &left}}) {
    const auto errors = flip_errors(*a, *b);
    ASSERT_TRUE(errors);
    for (const auto& [x, y] : {std::pair{0, 0}, {16, 12}, {15, 3}, {31, 23}, {7, 20}})
      EXPECT_NEAR((*errors)[static_cast<std::size_t>(y) * c_size.width + static_cast<std::size_t>(x)],
                  defined_error(*a, *b, x, y), 1e-6)
          << x << ',' << y;
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

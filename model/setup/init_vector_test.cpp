// SPDX-License-Identifier: Apache-2.0
// The drift of a word along a span whose start is centred.
#include "setup/init_vector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace halfway {
namespace {

constexpr int c_fraction = 22, c_bits = 33;

// The largest error of the rounded start plus k rounded slopes, in units of the word.
double drift(double start, double slope, std::int64_t steps, double centred) {
  const std::int64_t word = wrapped_word(centred, c_fraction, c_bits),
                     step = wrapped_word(slope, c_fraction, c_bits);
  double largest = 0.0;
  for (std::int64_t k = 0; k <= steps; ++k)
    largest = std::max(largest, std::abs(static_cast<double>(word + k * step) -
                                         std::ldexp(start + static_cast<double>(k) * slope, c_fraction)));
  return largest;
}

TEST(CentredStart, HalvesTheDrift) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> real(-1.0, 1.0);
  double centred = 0.0, plain = 0.0;
  for (int i = 0; i < 300; ++i) {
    const std::int64_t steps = i % 3 == 0 ? 4095 : i;
    const double start = real(random), slope = real(random) * 1e-3;
    const double bound = (1 + static_cast<double>(steps) / 2) / 2;
    const double found = drift(start, slope, steps, centred_start(start, slope, steps, c_fraction));
    EXPECT_LE(found, bound * (1 + 1e-6)) << start << ' ' << slope << ' ' << steps;
    centred = std::max(centred, found / bound);
    plain = std::max(plain, drift(start, slope, steps, start) / bound);
  }
  EXPECT_GT(centred, 0.95);
  EXPECT_GT(plain, 1.8) << "a start that is not centred drifts as far";
}

TEST(CentredStart, IsTheStartOfASinglePixel) {
  EXPECT_EQ(centred_start(0.3, 0.1, 0, c_fraction), 0.3);
}

}  // namespace
}  // namespace halfway

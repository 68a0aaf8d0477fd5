// SPDX-License-Identifier: Apache-2.0
#include "common/sine_cosine.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "common/test/big_real.hpp"

namespace halfway {
namespace {

void expect_nearest(double radians) {
  const SineCosine found = sine_cosine(radians);
  EXPECT_EQ(found.sine, static_cast<double>(sin(BigReal(radians)))) << radians;
  EXPECT_EQ(found.cosine, static_cast<double>(cos(BigReal(radians)))) << radians;
}

TEST(SineCosine, AreTheNearestDoubles) {
  for (int parts = 1; parts <= 200; ++parts)
    for (int i = 0; i <= 2 * parts; ++i) expect_nearest(std::numbers::pi * i / parts);
  std::mt19937_64 random(1);
  for (int i = 0; i < 100'000; ++i)
    expect_nearest(std::uniform_real_distribution<double>(-65536.0, 65536.0)(random));
  for (int exponent = -300; exponent < 16; ++exponent)
    expect_nearest(std::ldexp(std::uniform_real_distribution<double>(-1.0, 1.0)(random), exponent));
  expect_nearest(0.0);
}

}  // namespace
}  // namespace halfway

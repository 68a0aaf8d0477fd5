// SPDX-License-Identifier: Apache-2.0
#include "common/cosine_power.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace halfway {
namespace {

TEST(CosinePower, SteepestSlope) {
  for (const double n : {1.0, 1.5, 2.0, 5.0, 20.0, 1000.0}) {
    double steepest = 0.0;
    for (int i = 0; i <= 100'000; ++i) {
      const double angle = 1.5707963267948966 * i / 100'000;
      steepest = std::max(steepest, n * std::pow(std::cos(angle), n - 1.0) * std::sin(angle));
    }
    EXPECT_LE(steepest, steepest_slope(n) * (1 + 1e-12)) << n;
    EXPECT_GT(steepest, steepest_slope(n) * (1 - 1e-6)) << n;
  }
  EXPECT_TRUE(std::isinf(steepest_slope(0.5)));
}

}  // namespace
}  // namespace halfway

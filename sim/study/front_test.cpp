// SPDX-License-Identifier: Apache-2.0
#include "sim/study/front.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace halfway::study {
namespace {

constexpr double c_unbounded = std::numeric_limits<double>::infinity();

// Draw costs from a few values, so that points tie in one, several or all costs.
std::vector<Costs> random_points(std::mt19937& random) {
  const std::size_t figures = 1 + random() % 4;
  std::vector<Costs> points(1 + random() % 40);
  for (Costs& point : points)
    for (std::size_t i = 0; i < figures; ++i)
      point.push_back(random() % 16 == 0 ? c_unbounded : static_cast<double>(random() % 6));
  return points;
}

TEST(Front, HasThePointsThatNoOtherBeats) {
  EXPECT_TRUE(front_of({}).empty());
  std::mt19937 random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const std::vector<Costs> points = random_points(random);
    const auto front = front_of(points);
    ASSERT_FALSE(front.empty());
    for (std::size_t i = 0; i < points.size(); ++i) {
      bool beaten = false;
      for (const Costs& other : points) {
        bool as_good = true, better = false;
        for (std::size_t f = 0; f < other.size(); ++f) {
          as_good = as_good && other[f] <= points[i][f];
          better = better || other[f] < points[i][f];
        }
        beaten = beaten || (as_good && better);
      }
      EXPECT_NE(std::ranges::find(front, i) != front.end(), beaten) << trial << ": " << i;
    }
  }
}

TEST(Front, IsOrderedByTheFirstCost) {
  const std::vector<Costs> points = {{5, 1}, {9, 9}, {2, 3}, {2, 3}, {3, 2}};
  EXPECT_EQ(ordered_front_of(points), (std::vector<std::size_t>{2, 3, 4, 0}));
}

}  // namespace
}  // namespace halfway::study

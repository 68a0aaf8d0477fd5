// SPDX-License-Identifier: Apache-2.0
#include "sim/study/front.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace halfway::study {
namespace {

using ::testing::ElementsAre;

TEST(Front, HasThePointsThatNoOtherBeats) {
  EXPECT_THAT(front_of({}), ElementsAre());
  // Points 2 and 3 are equal. Point 5 is beaten in one cost only; 6 has the worst value in one cost.
  constexpr double c_unbounded = std::numeric_limits<double>::infinity();
  const std::vector<Costs> points = {{5, 1}, {9, 9}, {2, 3}, {2, 3}, {3, 2}, {5, 2}, {1, c_unbounded}};
  EXPECT_THAT(front_of(points), ElementsAre(0U, 2U, 3U, 4U, 6U));
  EXPECT_THAT(ordered_front_of(points), ElementsAre(6U, 2U, 3U, 4U, 0U));
  // A point that ties in two costs is beaten in the third.
  EXPECT_THAT(front_of(std::vector<Costs>{{1, 1, 2}, {1, 1, 1}, {1, 0, 3}}), ElementsAre(1U, 2U));
}

}  // namespace
}  // namespace halfway::study

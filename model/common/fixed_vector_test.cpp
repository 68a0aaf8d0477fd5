// SPDX-License-Identifier: Apache-2.0
#include "common/fixed_vector.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace halfway {
namespace {

TEST(FixedVector, HoldsElementsInOrderUpToItsSize) {
  FixedVector<int, 3> numbers;
  EXPECT_TRUE(numbers.empty());
  for (const int n : {5, 7, 9}) numbers.push_back(n);
  EXPECT_EQ(numbers.size(), 3u);
  EXPECT_EQ(numbers.front(), 5);
  EXPECT_EQ(numbers[1], 7);
  EXPECT_EQ(numbers.back(), 9);
  EXPECT_EQ(std::accumulate(numbers.begin(), numbers.end(), 0), 21);
  const FixedVector<int, 3> copy = numbers;
  numbers.clear();
  EXPECT_TRUE(numbers.empty());
  EXPECT_EQ(copy.size(), 3u);
}

TEST(FixedVectorDeathTest, RefusesAnElementTooMany) {
  FixedVector<int, 1> numbers;
  numbers.push_back(1);
  EXPECT_DEATH(numbers.push_back(2), "size_ < N");
}

}  // namespace
}  // namespace halfway

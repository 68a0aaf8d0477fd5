// SPDX-License-Identifier: Apache-2.0
#include "common/recent_values.hpp"

#include <gtest/gtest.h>

#include <random>

namespace halfway {
namespace {

struct Key {
  int number = -1;
  std::size_t hash() const { return static_cast<std::size_t>(number); }
  friend bool operator==(const Key&, const Key&) = default;
};

TEST(RecentValues, GivesTheValueOfTheKey) {
  RecentValues<Key, int, 8> values;
  std::mt19937 random(1);
  int made = 0, used = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Key key{static_cast<int>(random() % 12)};
    const int value = values.get(key, [&] { return ++made, 7 * key.number; });
    ASSERT_EQ(value, 7 * key.number);
    ++used;
  }
  // Keys 4 to 7 keep their places; 0 to 3 and 8 to 11 share four.
  EXPECT_LT(made, used / 2);
  EXPECT_GT(made, 12);
}

}  // namespace
}  // namespace halfway

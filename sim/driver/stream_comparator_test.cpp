// SPDX-License-Identifier: Apache-2.0
#include "sim/driver/stream_comparator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace halfway {
namespace {

// Pairs and separate streams in pieces of any length give equal results.
TEST(StreamComparator, PairsAndStreamsGiveEqualResults) {
  std::vector<Fragment> golden(5000), rtl;
  for (std::uint32_t i = 0; i < golden.size(); ++i)
    golden[i] = {.triangle = i / 7, .z = i * i, .y = 3, .x = 4};
  rtl = golden;
  rtl[1500].z ^= 1;
  rtl[4000].red = 9;
  rtl.pop_back();
  for (const std::size_t ahead : {0U, 1U, 700U}) {
    StreamComparator pairs;
    for (std::size_t from = 0, rtl_from = 0; from < golden.size() || rtl_from < rtl.size();) {
      const std::size_t count = std::min<std::size_t>(900, golden.size() - from);
      const std::size_t rtl_count = std::min<std::size_t>(900 - ahead, rtl.size() - rtl_from);
      pairs.add(std::span(golden).subspan(from, count), std::span(rtl).subspan(rtl_from, rtl_count));
      from += count;
      rtl_from += rtl_count;
    }
    EXPECT_EQ(pairs.mismatches(), 2U) << ahead;
    pairs.finish();
    EXPECT_EQ(pairs.mismatches(), 3U) << ahead;
    ASSERT_EQ(pairs.first().size(), 3U);
    EXPECT_EQ(pairs.first()[0].index, 1500U);
    EXPECT_EQ(pairs.first()[1].index, 4000U);
    EXPECT_EQ(pairs.first()[2].index, 4999U);
    EXPECT_EQ(pairs.golden_count(), golden.size());
  }
}

}  // namespace
}  // namespace halfway

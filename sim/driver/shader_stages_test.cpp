// SPDX-License-Identifier: Apache-2.0
#include "sim/driver/shader_stages.hpp"

#include <gtest/gtest.h>

namespace halfway {
namespace {

TEST(WordTrace, HasTheBitsOfEachPartAtEachEdge) {
  // The words of an edge: a flag, bits 44 to 5 of `wide`, bits 75 to 64 of `wide`.
  const SignalTrace trace =
      word_trace({{"flag", "flag", 0, 1}, {"wide", "wide", 5, 40}, {"wide", "wide", 64, 12}},
                 {1, 0x89abcdef, 0x12, 0x345, 0, 0xffffffff, 0, 0xfff});
  EXPECT_EQ(trace.edges, 2U);
  EXPECT_EQ(trace.part("flag", 0, 0, 1), 1U);
  EXPECT_EQ(trace.part("flag", 1, 0, 1), 0U);
  EXPECT_EQ(trace.part("wide", 0, 5, 40), 0x1289abcdefU);
  EXPECT_EQ(trace.part("wide", 0, 33, 8), 0x28U);
  EXPECT_EQ(trace.part("wide", 1, 25, 20), 0xfffU);
  EXPECT_EQ(trace.part("wide", 1, 64, 12), 0xfffU);
  // No such signal, edge or bit.
  EXPECT_EQ(trace.part("other", 0, 0, 1), std::nullopt);
  EXPECT_EQ(trace.part("flag", 2, 0, 1), std::nullopt);
  EXPECT_EQ(trace.part("wide", 0, 4, 5), std::nullopt);
  EXPECT_EQ(trace.part("wide", 0, 40, 30), std::nullopt);
}

}  // namespace
}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// The register keeps every word of the stream, in order, for any pattern of valid and ready.
#include "golden/stream_register.hpp"

#include <gtest/gtest.h>

#include <random>

namespace halfway::golden {
namespace {

TEST(StreamRegister, LosesAndRepeatsNothing) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    const unsigned valid_of_8 = 1 + seed % 8, ready_of_8 = 1 + seed / 3;
    StreamRegister<unsigned> stage;
    unsigned sent = 0, received = 0;
    bool waited = false;
    unsigned waiting = 0;
    for (int clock = 0; clock < 2000; ++clock) {
      const bool in_valid = random() % 8 < valid_of_8, out_ready = random() % 8 < ready_of_8;
      const bool taken = in_valid && stage.in_ready(out_ready), given = stage.out_valid() && out_ready;
      if (waited) {
        ASSERT_TRUE(stage.out_valid());
        ASSERT_EQ(stage.out_data(), waiting);
      }
      if (given) {
        ASSERT_EQ(stage.out_data(), received);
        ++received;
      }
      waited = stage.out_valid() && !out_ready;
      if (waited) waiting = stage.out_data();
      // A word that is not accepted stays offered. A word that is not offered must not be stored.
      stage.clock(false, in_valid, in_valid ? sent : ~0U, out_ready);
      if (taken) ++sent;
      ASSERT_EQ(sent - received, stage.out_valid() ? 1u : 0u);
    }
    EXPECT_GT(received, 100u);
  }
}

TEST(StreamRegister, TransfersOneWordPerClock) {
  StreamRegister<int> stage;
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(stage.in_ready(true));
    stage.clock(false, true, i, true);
    ASSERT_TRUE(stage.out_valid());
    ASSERT_EQ(stage.out_data(), i);
  }
}

TEST(StreamRegister, ResetEmptiesIt) {
  StreamRegister<int> stage;
  stage.clock(false, true, 7, false);
  ASSERT_TRUE(stage.out_valid());
  stage.clock(true, true, 8, true);
  EXPECT_FALSE(stage.out_valid());
}

}  // namespace
}  // namespace halfway::golden

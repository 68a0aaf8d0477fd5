// SPDX-License-Identifier: Apache-2.0
#include "sim/os/printable.hpp"

#include <gtest/gtest.h>

namespace halfway {
namespace {

TEST(Printable, TakesControlCharactersOut) {
  EXPECT_EQ(printable("a\x1b[31mb\rc\x7f\x01"), "a?[31mb?c??");
  EXPECT_EQ(printable("x\xc2\x9b\x31m\xc2"), "x??1m\xc2");
}

TEST(Printable, LeavesTheRest) {
  const char* text = "caf\xc3\xa9:\t\"1\"\n\xc2\xa0";
  EXPECT_EQ(printable(text), text);
}

}  // namespace
}  // namespace halfway

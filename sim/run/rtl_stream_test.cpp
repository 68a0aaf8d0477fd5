// SPDX-License-Identifier: Apache-2.0
#include "sim/run/rtl_stream.hpp"

#include <gtest/gtest.h>

#include <array>

namespace halfway {
namespace {

// Wrong hardware's frame has whatever lies in it, before and behind what does not.
TEST(RtlStream, KeepsWhatLiesInTheFrame) {
  const auto fragment = [](std::uint16_t x, std::uint8_t red) {
    return Fragment{.triangle = 0, .z = 1, .y = 0, .x = x, .red = red, .green = 0, .blue = 0};
  };
  RtlStream stream({3, 1}, {}, false);
  stream.add(std::array{fragment(0, 10), fragment(7, 99), fragment(1, 20), fragment(8, 99)});
  stream.add(std::array{fragment(9, 99)});
  stream.add(std::array{fragment(2, 30)});
  EXPECT_EQ(stream.assembler().frame().rgb, (std::vector<std::uint8_t>{10, 0, 0, 20, 0, 0, 30, 0, 0}));
  EXPECT_EQ(stream.count(), 6U);
  EXPECT_FALSE(stream.finish("verilator").equal());
}

}  // namespace
}  // namespace halfway

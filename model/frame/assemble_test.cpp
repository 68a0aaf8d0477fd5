// SPDX-License-Identifier: Apache-2.0
#include "frame/assemble.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "common/test/is_error.hpp"

namespace halfway {
namespace {

Fragment fragment(std::uint16_t x, std::uint16_t y, std::uint32_t z, std::uint8_t red) {
  return {.triangle = 0, .z = z, .y = y, .x = x, .red = red, .green = 2, .blue = 3};
}

TEST(Assemble, SmallerZWinsAndTheFirstOfEqualOnesStays) {
  FrameAssembler assembler({3, 2}, {0.0, 0.5, 1.0});
  const std::array fragments{fragment(1, 0, 500, 10), fragment(1, 0, 500, 11), fragment(1, 0, 501, 12),
                             fragment(2, 1, 9, 20),   fragment(2, 1, 8, 21),   fragment(0, 1, 0xffffff, 30)};
  ASSERT_TRUE(assembler.add(fragments));
  ASSERT_TRUE(assembler.add(std::array{fragment(1, 0, 500, 13)}));
  EXPECT_EQ(assembler.frame().rgb, (std::vector<std::uint8_t>{0, 128, 255, 10, 2, 3, 0, 128, 255,  //
                                                              30, 2, 3, 0, 128, 255, 21, 2, 3}));
  EXPECT_EQ(assembler.mask(), (std::vector<std::uint8_t>{0, 1, 0, 1, 0, 1}));
  EXPECT_EQ(assembler.fragments(), 7u);
  EXPECT_EQ(assembler.covered_pixels(), 3u);
}

TEST(Assemble, RefusesFragmentsOutside) {
  for (const Fragment& bad : {fragment(3, 0, 1, 1), fragment(0, 2, 1, 1), fragment(65535, 65535, 1, 1),
                              fragment(0, 0, 1u << 24, 1), fragment(0, 0, 0xffffffff, 1)}) {
    FrameAssembler assembler({3, 2}, {});
    EXPECT_TRUE(
        is_error(assembler.add(std::array{fragment(2, 1, 5, 77), bad}), ExitCode::differs, "fragments:2:"));
    EXPECT_EQ(assembler.frame().rgb[15], 77);
    EXPECT_EQ(assembler.covered_pixels(), 1u);
  }
}

TEST(Assemble, KeepsOnlyATile) {
  FrameAssembler assembler({8, 8}, {2, 1, {2, 2}}, {});
  ASSERT_TRUE(assembler.add(std::array{fragment(2, 1, 5, 10), fragment(3, 2, 6, 20), fragment(1, 1, 1, 30),
                                       fragment(4, 1, 1, 31), fragment(2, 0, 1, 32), fragment(2, 3, 1, 33)}));
  EXPECT_EQ(assembler.frame().rgb, (std::vector<std::uint8_t>{10, 2, 3, 0, 0, 0, 0, 0, 0, 20, 2, 3}));
  EXPECT_EQ(assembler.fragments(), 6U);
  EXPECT_EQ(assembler.fragments_inside(), 2U);
  EXPECT_EQ(assembler.depth(0, 0), 5U);
  EXPECT_EQ(assembler.depth(1, 0), std::nullopt);
  EXPECT_FALSE(assembler.add(std::array{fragment(8, 1, 5, 10)}));
}

}  // namespace
}  // namespace halfway

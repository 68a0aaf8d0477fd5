// SPDX-License-Identifier: Apache-2.0
#include "golden/frame_memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "frame/assemble.hpp"

namespace halfway::golden {
namespace {

constexpr FrameSize c_size{37, 11};
constexpr std::uint32_t c_origin = 0x1000, c_bytes = 0x4000;

FramePlace whole_place() {
  return {.colour_base = c_origin,
          .colour_stride = 256,
          .depth_base = c_origin + c_bytes / 2,
          .depth_stride = 512,
          .width = c_size.width,
          .height = c_size.height,
          .right = c_size.width,
          .bottom = c_size.height};
}

std::vector<Fragment> random_fragments(std::size_t count) {
  std::mt19937 random(1);
  std::vector<Fragment> fragments;
  for (std::size_t i = 0; i < count; ++i)
    fragments.push_back({.z = static_cast<std::uint32_t>(random() % 3 == 0 ? 0xFFFFFF : random() % 200),
                         .y = static_cast<std::uint16_t>(random() % c_size.height),
                         .x = static_cast<std::uint16_t>(random() % c_size.width),
                         .red = static_cast<std::uint8_t>(random()),
                         .green = static_cast<std::uint8_t>(random()),
                         .blue = static_cast<std::uint8_t>(random())});
  return fragments;
}

TEST(FrameMemory, DrawsTheFrameOfTheAssembler) {
  std::vector<std::uint8_t> bytes(c_bytes, 0x5A);
  FrameMemory memory(PixelFormat::xrgb8888, bytes, c_origin);
  memory.clear(whole_place(), 255, 0, 255);
  FrameAssembler assembler(c_size, {1, 0, 1});
  const auto fragments = random_fragments(600);
  for (const Fragment& fragment : fragments) memory.draw(whole_place(), fragment);
  ASSERT_TRUE(assembler.add(fragments));
  std::size_t in_frame = 0;
  for (std::uint32_t y = 0; y < c_size.height; ++y)
    for (std::uint32_t x = 0; x < c_size.width; ++x, in_frame += 8) {
      const std::uint8_t* colour = &bytes[256 * y + 4 * x];
      const std::uint8_t* depth = &bytes[c_bytes / 2 + 512 * y + 4 * x];
      const std::uint8_t* rgb = &assembler.frame().rgb[assembler.frame().offset(x, y)];
      EXPECT_EQ(std::vector(colour, colour + 4), (std::vector<std::uint8_t>{rgb[2], rgb[1], rgb[0], 0}));
      const std::uint32_t z = assembler.depth(x, y).value_or(~0u);
      EXPECT_EQ(depth[0] | depth[1] << 8 | depth[2] << 16 | std::uint32_t{depth[3]} << 24, z);
    }
  // No other byte has changed.
  EXPECT_GE(static_cast<std::size_t>(std::ranges::count(bytes, 0x5A)), c_bytes - in_frame);
}

TEST(FrameMemory, ComparesUpperSixteenBits) {
  std::vector<std::uint8_t> bytes(c_bytes);
  FrameMemory memory(PixelFormat::rgb565, bytes, c_origin);
  memory.clear(whole_place(), 0, 0, 0);
  const auto colour = [&] { return bytes[0] | bytes[1] << 8; };
  EXPECT_FALSE(memory.draw(whole_place(), {.z = 0xFFFF00, .red = 255}));
  EXPECT_EQ(colour(), 0);  // as far as the clear
  EXPECT_TRUE(memory.draw(whole_place(), {.z = 0x1234FF, .red = 255}));
  EXPECT_FALSE(memory.draw(whole_place(), {.z = 0x123400, .green = 255}));
  EXPECT_EQ(colour(), 0xF800);  // equal: the first stays
  EXPECT_TRUE(memory.draw(whole_place(), {.z = 0x1233FF, .blue = 255}));
  EXPECT_EQ(colour(), 0x001F);
}

TEST(FrameMemory, ScissorLimitsFragmentsAndClear) {
  std::vector<std::uint8_t> bytes(c_bytes, 0x5A);
  FrameMemory memory(PixelFormat::rgb565, bytes, c_origin);
  FramePlace place = whole_place();
  place.left = 3, place.right = 5, place.top = 2, place.bottom = 3;
  memory.clear(place, 0, 0, 0);
  for (std::uint16_t y = 0; y < 20; ++y)
    for (std::uint16_t x = 0; x < 50; ++x) memory.draw(place, {.y = y, .x = x, .red = 0});
  EXPECT_EQ(std::ranges::count(bytes, 0x5A), c_bytes - 2 * 2 * 2);
}

}  // namespace
}  // namespace halfway::golden

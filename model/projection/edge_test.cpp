// SPDX-License-Identifier: Apache-2.0
// The pixels of the smallest triangles. Which pixels a triangle covers: setup/walk_test.cpp compares
// for_each_span with the golden walker, tb/specification compares both with exact integers.
#include "projection/edge.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <vector>

namespace halfway {
namespace {

void expect_three_of_a_block(const std::array<ScreenPoint, 3>& p, int unit_bits) {
  const std::vector<Pixel> pixels = covered_pixels(p, unit_bits, {8, 8});
  ASSERT_LE(pixels.size(), 3u) << p[0].x << ',' << p[0].y << ' ' << p[1].x << ',' << p[1].y << ' ' << p[2].x
                               << ',' << p[2].y << " at " << unit_bits << " bits";
  for (const Pixel& a : pixels)
    for (const Pixel& b : pixels) ASSERT_TRUE(std::abs(a.x - b.x) <= 1 && std::abs(a.y - b.y) <= 1);
}

TEST(Edge, ATriangleOfTwoPixelsCoversAtMostThreeOfABlock) {
  // Every triangle with corners on the grid of 1/4 pixel, from every position within a pixel.
  constexpr int c_bits = 2, c_side = 2 << c_bits, c_points = (c_side + 1) * (c_side + 1);
  std::size_t three = 0;
  for (int position = 0; position < 1 << (2 * c_bits); ++position) {
    const auto point = [&](int i) {
      return ScreenPoint{4 + position % (1 << c_bits) + i % (c_side + 1),
                         4 + position / (1 << c_bits) + i / (c_side + 1)};
    };
    for (int a = 0; a < c_points; ++a)
      for (int b = 0; b < a; ++b)
        for (int c = 0; c < b; ++c) {
          const std::array<ScreenPoint, 3> p = {point(a), point(b), point(c)};
          expect_three_of_a_block(p, c_bits);
          if (testing::Test::HasFatalFailure()) return;
          three += covered_pixels(p, c_bits, {8, 8}).size() == 3;
        }
  }
  EXPECT_GT(three, 1000u);
  // A triangle that is wider and higher by one unit may cover more.
  EXPECT_GT(covered_pixels({{{6, 6}, {15, 6}, {6, 15}}}, 2, {8, 8}).size(), 3u);
}

}  // namespace
}  // namespace halfway

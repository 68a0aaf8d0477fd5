// SPDX-License-Identifier: Apache-2.0
// Compares for_each_span and Edge with coverage by edge functions in 128-bit integers.
#include "projection/edge.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "common/exact_division.hpp"
#include "setup/test/random_triangles.hpp"

namespace halfway {
namespace {

/// How often each pixel of a frame is covered.
struct Counts {
  explicit Counts(FrameSize s) : size(s), count(std::size_t{s.width} * s.height) {}
  FrameSize size;
  std::vector<int> count;
  int& at(std::uint32_t x, std::uint32_t y) { return count[std::size_t{y} * size.width + x]; }
};

void add_spans(const Points& p, int unit_bits, Counts& counts) {
  std::int64_t last_y = -1;
  for_each_span(p, unit_bits, counts.size, [&](std::uint32_t y, std::uint32_t begin, std::uint32_t end) {
    ASSERT_GT(std::int64_t{y}, last_y);
    ASSERT_LT(y, counts.size.height);
    ASSERT_LT(begin, end);
    ASSERT_LE(end, counts.size.width);
    last_y = y;
    for (std::uint32_t x = begin; x < end; ++x) ++counts.at(x, y);
  });
}

/// In half units, so that pixel centres are integers.
bool covers(Points p, int unit_bits, std::uint32_t x, std::uint32_t y) {
  const Int128 centre_x = (2 * Int128{x} + 1) << unit_bits, centre_y = (2 * Int128{y} + 1) << unit_bits;
  const auto side = [&](ScreenPoint from, ScreenPoint to) {
    return (Int128{to.x} - from.x) * (centre_y - 2 * Int128{from.y}) -
           (Int128{to.y} - from.y) * (centre_x - 2 * Int128{from.x});
  };
  const Int128 area = (Int128{p[1].x} - p[0].x) * (Int128{p[2].y} - p[0].y) -
                      (Int128{p[1].y} - p[0].y) * (Int128{p[2].x} - p[0].x);
  if (area == 0) return false;
  if (area < 0) std::swap(p[1], p[2]);
  for (int i = 0; i < 3; ++i) {
    const ScreenPoint from = p[i], to = p[(i + 1) % 3];
    const Int128 s = side(from, to);
    const bool top_left = to.y < from.y || (to.y == from.y && to.x > from.x);
    if (s < 0 || (s == 0 && !top_left)) return false;
  }
  return true;
}

void expect_exact(const Points& p, int unit_bits, FrameSize frame) {
  Counts counts(frame);
  add_spans(p, unit_bits, counts);
  for (std::uint32_t y = 0; y < frame.height; ++y)
    for (std::uint32_t x = 0; x < frame.width; ++x)
      ASSERT_EQ(counts.at(x, y), covers(p, unit_bits, x, y) ? 1 : 0)
          << "pixel " << x << ',' << y << " of (" << p[0].x << ',' << p[0].y << ") (" << p[1].x << ','
          << p[1].y << ") (" << p[2].x << ',' << p[2].y << ") unit_bits " << unit_bits;
}

TEST(Edge, CoversExactlyTheCentresByTheTopLeftRule) {
  for (int unit_bits = 4; unit_bits <= 9; ++unit_bits)
    for (const TriangleKind kind : c_triangle_kinds) {
      RandomTriangles random(1000u * static_cast<unsigned>(unit_bits) + static_cast<unsigned>(kind));
      for (int i = 0; i < 300; ++i) {
        expect_exact(random.next(kind, unit_bits, {24, 20}), unit_bits, {24, 20});
        if (HasFatalFailure()) return;
      }
    }
}

TEST(Edge, ATriangleWithoutAreaCoversNothing) {
  std::mt19937 random(11);
  std::uniform_int_distribution<std::int32_t> coordinate(-100, 500), step(-3, 3);
  for (int i = 0; i < 2000; ++i) {
    const ScreenPoint a{coordinate(random), coordinate(random)};
    const std::int32_t dx = coordinate(random), dy = coordinate(random), m = step(random), n = step(random);
    Counts counts({24, 20});
    add_spans({a, {a.x + m * dx, a.y + m * dy}, {a.x + n * dx, a.y + n * dy}}, 4, counts);
    for (int c : counts.count) ASSERT_EQ(c, 0);
  }
}

// Stepping line by line, as the hardware's edge walker does, must give the result of at() on each line.
TEST(Edge, SteppingByQuotientAndRemainderReproducesAt) {
  for (int unit_bits = 4; unit_bits <= 9; ++unit_bits)
    for (const TriangleKind kind : c_triangle_kinds) {
      RandomTriangles random(77u + static_cast<unsigned>(unit_bits));
      for (int i = 0; i < 60; ++i) {
        const Points p = random.next(kind, unit_bits, {24, 20}, unit_bits - 4);
        const auto [top, bottom] = p[0].y < p[1].y ? std::pair(p[0], p[1]) : std::pair(p[1], p[0]);
        if (top.y == bottom.y) continue;
        const Edge edge(top, bottom, unit_bits);
        const FlooredQuotient slope = floor_divide(edge.dx(), edge.dy());
        const std::int64_t begin = first_line(top.y, unit_bits), end = first_line(bottom.y, unit_bits);
        Edge::State state = edge.at(begin);
        for (std::int64_t y = begin; y < end; ++y) {
          const Edge::State expected = edge.at(y);
          ASSERT_EQ(state.pixel, expected.pixel) << "line " << y;
          ASSERT_EQ(state.error, expected.error) << "line " << y;
          ASSERT_GE(state.error, 0);
          ASSERT_LT(state.error, edge.dy());
          state.pixel += slope.quotient;
          state.error -= slope.remainder;
          if (state.error < 0) {
            state.error += edge.dy();
            ++state.pixel;
          }
        }
      }
    }
}

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

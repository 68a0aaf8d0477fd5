// SPDX-License-Identifier: Apache-2.0
// Compares the halves of triangles with integer vertices with their edges in rational arithmetic. Runs the
// golden triangle walker with their headers.
#include "setup/half_triangle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include "golden/triangle_walker.hpp"
#include "golden/z_interpolator.hpp"

namespace halfway {
namespace {

using words::Published;
using Triangle = std::array<HalfVertex, 3>;

// Sizes up to the frame's; some are flat at the top or the bottom, some have zero area.
class RandomHalves {
 public:
  explicit RandomHalves(unsigned seed) : random_(seed) {}
  Triangle next() {
    const int reach = 1 << within(1, 12), left = within(0, 4096 - reach), top = within(0, 4096 - reach);
    const auto vertex = [&] {
      return HalfVertex{static_cast<long double>(left + within(0, reach - 1)),
                        static_cast<long double>(top + within(0, reach - 1)),
                        static_cast<long double>(within(1, (1 << 24) - 3))};
    };
    Triangle p = {vertex(), vertex(), vertex()};
    if (within(0, 5) == 0) p[1].y = p[0].y;
    if (within(0, 9) == 0) p[2] = p[0];
    return p;
  }

 private:
  int within(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  std::mt19937 random_;
};

// All terms are integers: exact.
long double x_times_dy(const Triangle& p, HalfEdge e, std::int64_t y) {
  const HalfVertex &a = p[e.top], &b = p[e.bottom];
  return a.x * (b.y - a.y) + (b.x - a.x) * (static_cast<long double>(y) - a.y);
}
long double edge_x(const Triangle& p, HalfEdge e, std::int64_t y) {
  return x_times_dy(p, e, y) / (p[e.bottom].y - p[e.top].y);
}

TEST(HalfTriangle, NoneWhereThereIsNoArea) {
  const auto halves = [](Triangle p) { return half_triangles(p).size(); };
  EXPECT_EQ(halves({{{1, 2, 0}, {3, 4, 0}, {5, 6, 0}}}), 0u);
  EXPECT_EQ(halves({{{1, 2, 0}, {1, 2, 0}, {5, 6, 0}}}), 0u);
  EXPECT_EQ(halves({{{1, 2, 0}, {7, 2, 0}, {5, 2, 0}}}), 0u);
  EXPECT_EQ(halves({{{1, 2, 0}, {1, 3, 0}, {1, 9, 0}}}), 0u);
  EXPECT_EQ(halves({{{1, 2, 0}, {7, 2, 0}, {5, 3, 0}}}), 1u);
  EXPECT_EQ(halves({{{1, 2, 0}, {7, 3, 0}, {5, 3, 0}}}), 1u);
  EXPECT_EQ(halves({{{1, 2, 0}, {7, 3, 0}, {5, 4, 0}}}), 2u);
}

TEST(HalfTriangle, HalvesLieBetweenTheTrianglesOwnEdges) {
  RandomHalves random(1);
  int two = 0, upper = 0, lower = 0, none = 0;
  for (int i = 0; i < 20000; ++i) {
    const Triangle p = random.next();
    const std::vector<HalfTriangle> halves = half_triangles(p);
    long double top = p[0].y, bottom = p[0].y;
    for (const HalfVertex& v : p) top = std::min(top, v.y), bottom = std::max(bottom, v.y);
    ASSERT_EQ(halves.empty(), twice_area(p) == 0);
    if (halves.empty()) {
      ++none;
      continue;
    }
    // The halves cover all lines from top to bottom without a gap. Both contain the line of the middle
    // vertex.
    ASSERT_LE(halves.size(), 2u);
    ASSERT_EQ(halves.front().y, top);
    ASSERT_EQ(halves.back().y + halves.back().lines - 1, bottom);
    if (halves.size() == 2) {
      ASSERT_EQ(halves[0].y + halves[0].lines - 1, halves[1].y);
      const bool its_vertex = p[0].y == halves[1].y || p[1].y == halves[1].y || p[2].y == halves[1].y;
      ASSERT_TRUE(its_vertex);
      ++two;
    } else {
      ++(p[halves[0].start.top].y == p[halves[0].stop.top].y && halves[0].start.top != halves[0].stop.top
             ? lower
             : upper);
    }
    for (const HalfTriangle& h : halves) {
      ASSERT_GE(h.lines, 2);
      for (const HalfEdge edge : {h.start, h.stop}) {
        ASSERT_LE(p[edge.top].y, h.y);
        ASSERT_GE(p[edge.bottom].y, h.y + h.lines - 1);
      }
      ASSERT_FALSE(h.start.top == h.stop.top && h.start.bottom == h.stop.bottom);
      // Compare left and right exactly: never reversed on any line, and different on at least one.
      bool apart = false;
      for (const std::int64_t y : {h.y, h.y + h.lines - 1}) {
        const long double dy_start = p[h.start.bottom].y - p[h.start.top].y,
                          dy_stop = p[h.stop.bottom].y - p[h.stop.top].y;
        const long double left = x_times_dy(p, h.start, y) * dy_stop,
                          right = x_times_dy(p, h.stop, y) * dy_start;
        ASSERT_LE(left, right);
        apart = apart || left < right;
      }
      ASSERT_TRUE(apart);
      const auto near = [](long double value, long double expected) {
        return std::fabs(value - expected) <= 0x1p-50L * 4096;
      };
      ASSERT_TRUE(near(h.x_start, edge_x(p, h.start, h.y)));
      ASSERT_TRUE(near(h.x_stop, edge_x(p, h.stop, h.y)));
      ASSERT_TRUE(near(h.slope_start, edge_x(p, h.start, h.y + 1) - edge_x(p, h.start, h.y)));
      ASSERT_TRUE(near(h.slope_stop, edge_x(p, h.stop, h.y + 1) - edge_x(p, h.stop, h.y)));
    }
  }
  for (const int count : {two, upper, lower, none}) EXPECT_GT(count, 500);
}

// The golden walk covers each line from the pixel nearest to one edge to the pixel nearest to the other,
// within the rounding of the slopes. The depth is that of the plane.
TEST(HalfTriangle, TheHardwareWalksFromEdgeToEdge) {
  RandomHalves random(2);
  double worst_depth = 0.0;
  std::uint64_t lines = 0, other_pixel = 0;
  for (int i = 0; i < 2000; ++i) {
    const Triangle p = random.next();
    for (const HalfTriangle& h : half_triangles(p)) {
      std::vector<std::uint32_t> words;
      InitVector init(words, Published::c_init_header_bits);
      put_header(init, 7, h, p);
      golden::TriangleWalker<Published> walker;
      golden::ZInterpolator<Published> depth;
      walker.line_load(words);
      depth.line_load(words);
      ASSERT_EQ(walker.triangle(), 7u);
      const long double d = twice_area(p);
      for (std::int64_t y = h.y;; ++y, ++lines) {
        ASSERT_EQ(walker.y(), y);
        // Start and slope are rounded to 2^-19. The slope's rounding accumulates once per line.
        const long double slack = static_cast<long double>(y - h.y + 1) * 0x1p-19L;
        const auto nearest = [&](long double x, std::int64_t pixel) {
          other_pixel += pixel != static_cast<std::int64_t>(std::floor(x + 0.5L));
          return pixel >= std::floor(x + 0.5L - slack) && pixel <= std::floor(x + 0.5L + slack);
        };
        const std::int64_t first = walker.start().value(), last = walker.stop().value() - 1;
        ASSERT_TRUE(nearest(edge_x(p, h.start, y), first)) << "line " << y << ": " << first;
        ASSERT_TRUE(nearest(edge_x(p, h.stop, y), last)) << "line " << y << ": " << last;
        if (!walker.line_empty() && y % 16 == 0) {
          // The depth starts on the edge at its real x, with the plane's value there, and adds z_dx per
          // pixel.
          depth.span_load();
          for (std::int64_t x = first; x < last; ++x) depth.span_step();
          const long double u = edge_x(p, h.start, y) + static_cast<long double>(last - first) - p[0].x,
                            v = static_cast<long double>(y) - p[0].y;
          const long double x2 = p[1].x - p[0].x, y2 = p[1].y - p[0].y, x3 = p[2].x - p[0].x,
                            y3 = p[2].y - p[0].y, z2 = p[1].z - p[0].z, z3 = p[2].z - p[0].z;
          const long double z = p[0].z + ((z2 * y3 - z3 * y2) * u + (z3 * x2 - z2 * x3) * v) / d;
          const long double bound =
              0x1p-16L * static_cast<long double>(1 + (y - h.y) + (last - first)) + 1e-6L;
          const long double value = std::ldexp(static_cast<long double>(depth.value().value()),
                                               -Published::c_depth_sum_fraction_bits);
          const long double error = std::remainder(
              value - 0.5L - z,
              std::ldexp(1.0L, Published::c_depth_sum_bits - Published::c_depth_sum_fraction_bits));
          ASSERT_LE(std::fabs(error), bound);
          worst_depth = std::max(worst_depth, static_cast<double>(std::fabs(error) / bound));
        }
        if (walker.line_last()) break;
        walker.line_step();
        depth.line_step(walker.carry());
      }
      ASSERT_EQ(walker.y(), h.y + h.lines - 1);
    }
  }
  EXPECT_GT(lines, 100'000u);
  EXPECT_LT(100 * other_pixel, lines);  // the slack matters only close to ties
  EXPECT_GT(worst_depth, 0.3);
}

TEST(HalfTriangle, ACornerBetweenPixelsTakesTheNearestOne) {
  for (int level = 0; level <= 5; ++level)
    for (std::int32_t v = -70; v <= 70; ++v) {
      const HalfVertex vertex = half_vertex({v, -v}, level, 7.5);
      const auto nearest = [&](std::int32_t w) { return std::floor(std::ldexp(w, -level) + 0.5L); };
      ASSERT_EQ(vertex.x, nearest(v)) << level;
      ASSERT_EQ(vertex.y, nearest(-v)) << level;
      ASSERT_EQ(vertex.z, 7.5L);
    }
}

}  // namespace
}  // namespace halfway

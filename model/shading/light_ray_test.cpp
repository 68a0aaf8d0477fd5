// SPDX-License-Identifier: Apache-2.0
#include "shading/light_ray.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <utility>

#include "common/exact_division.hpp"
#include "shading/test/random_solids.hpp"

namespace halfway {
namespace {

template <class Triangles>
std::pair<int, int> hits(const Triangles& triangles, const LightRay& ray) {
  int enters = 0, leaves = 0;
  for (const CornersWorld& corners : triangles) {
    const Crossing crossing = ray.hit(corners).crossing;
    enters += crossing == Crossing::enters;
    leaves += crossing == Crossing::leaves;
  }
  return {enters, leaves};
}

TEST(LightRay, SupportsEachKindOfLight) {
  Scene scene;
  scene.directional = {{{0, 1, 0}, {}}, {{0, 0, -1}, {}}};
  scene.positional = {{{3, 4, 5}, {}}};
  scene.spots = {{{6, 7, 8}, {0, 1, 0}, 0.9, 0.8, {}}};
  const glm::dvec3 point(1, 1, 1);
  EXPECT_EQ(light_of(scene, {LightKind::directional, 1}).point.way_from(point), glm::dvec3(0, 0, -1));
  EXPECT_EQ(light_of(scene, {LightKind::positional, 0}).point.way_from(point), glm::dvec3(2, 3, 4));
  EXPECT_EQ(light_of(scene, {LightKind::spot, 0}).point.way_from(point), glm::dvec3(5, 6, 7));
}

TEST(LightRay, AvertedTrianglesFaceAwayFromTheLight) {
  const CornersWorld up{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}};
  EXPECT_FALSE(is_averted(up, {{0, 1, 0}, 0.0}));
  EXPECT_TRUE(is_averted(up, {{0, -1, 0}, 0.0}));
  EXPECT_FALSE(is_averted(up, {{1, 0, 0}, 0.0}));  // edge-on
  EXPECT_FALSE(is_averted(up, {{7, 0.1, 0}, 1.0}));
  EXPECT_TRUE(is_averted(up, {{7, -0.1, 0}, 1.0}));
  EXPECT_FALSE(is_averted({{{0, 0, 0}, {0, 0, 1}, {0, 0, 2}}}, {{1, 2, 3}, 0.0}));
}

TEST(LightRay, ReportsDistanceAndDirection) {
  const CornersWorld up{{{-1, 2, -1}, {0, 2, 2}, {2, 2, -1}}};
  const LightRay from_below({0, 0, 0}, {{0, 8, 0}, 1.0}), from_above({0, 8, 0}, {{0, -1, 0}, 0.0});
  EXPECT_EQ(from_below.hit(up).crossing, Crossing::leaves);
  EXPECT_DOUBLE_EQ(from_below.hit(up).way, 0.25);
  EXPECT_EQ(from_above.hit(up).crossing, Crossing::enters);
  EXPECT_DOUBLE_EQ(from_above.hit(up).way, 6.0);
  EXPECT_EQ(from_below.hit(up, 0.3).crossing, Crossing::none);
  // Behind the start, and beyond the light.
  EXPECT_EQ(LightRay({0, 3, 0}, {{0, 1, 0}, 0.0}).hit(up).crossing, Crossing::none);
  EXPECT_EQ(LightRay({0, 0, 0}, {{0, 1.9, 0}, 1.0}).hit(up).crossing, Crossing::none);
}

// Rays through the vertices and edges of a lattice that is one sheet cross it exactly once.
TEST(LightRay, CrossesASheetOnceWhereverItIsAimed) {
  RandomSolids random(2);
  constexpr int c_cells = 6;
  for (int round = 0; round < 60; ++round) {
    // Integer coordinates, a random lattice in the plane, or one with vertices a few roundings off the plane.
    const glm::dvec3 u = round == 0 ? glm::dvec3(1, 0, 0) : random.unit();
    const glm::dvec3 v = round == 0 ? glm::dvec3(0, 0, 1) : random.unit();
    const double noise = round % 3 == 2 ? 1e-15 : 0.0;
    std::array<std::array<glm::dvec3, c_cells + 1>, c_cells + 1> at;
    for (int i = 0; i <= c_cells; ++i)
      for (int j = 0; j <= c_cells; ++j)
        at[i][j] = double(i - 3) * u + double(j - 3) * v + noise * random.cube(1.0);
    std::vector<CornersWorld> sheet;
    for (int i = 0; i < c_cells; ++i)
      for (int j = 0; j < c_cells; ++j) {
        sheet.push_back({at[i][j], at[i][j + 1], at[i + 1][j + 1]});
        sheet.push_back({at[i][j], at[i + 1][j + 1], at[i + 1][j]});
      }
    const glm::dvec3 across = glm::cross(u, v);
    for (int i = 2; i < 4 * c_cells - 2; ++i)
      for (int j = 2; j < 4 * c_cells - 2; ++j) {
        const glm::dvec3 target = (0.25 * i - 3.0) * u + (0.25 * j - 3.0) * v;
        for (const double side : {-1.0, 1.0}) {
          const auto [enters, leaves] = hits(sheet, LightRay(target - side * across, {side * across, 0.0}));
          ASSERT_EQ(enters + leaves, 1) << round << ": " << i << ',' << j;
          const glm::dvec3 askew = target - side * (across + 0.3 * u);
          const auto [enters2, leaves2] = hits(sheet, LightRay(askew, {2.0 * target - askew, 1.0}));
          ASSERT_EQ(enters2 + leaves2, 1) << round << ": " << i << ',' << j;
        }
      }
  }
}

// Slivers next to one another along a line that the ray meets or nearly meets. It passes their edges at such
// small distances that products in double are wrong, or equal although they should differ.
TEST(LightRay, CrossesOneOfManySlivers) {
  RandomSolids random(4);
  struct Point {
    std::int64_t x, y;
  };
  const auto cross = [](Point p, Point q) { return Int128{p.x} * q.y - Int128{p.y} * q.x; };
  int wrong_in_double = 0;
  for (int round = 0; round < 3000; ++round) {
    const auto whole = [&] { return static_cast<std::int64_t>(random.within(1e8, 1e9)); };
    const Point apex{whole(), whole()};
    // Euclid's algorithm: a point next to the line through origin and apex, at the least distance that
    // integers allow.
    Point close{0, 1}, before{1, 0};
    for (std::int64_t a = apex.x, b = apex.y; b != 0;) {
      const std::int64_t quotient = a / b;
      a = std::exchange(b, a % b);
      before = std::exchange(close, {before.x - quotient * close.x, before.y - quotient * close.y});
    }
    close = {-before.y, before.x};  // apex.x before.x + apex.y before.y is the greatest common divisor
    std::vector<Point> rim;
    for (int i = 0; i < 12; ++i) {
      const auto aside = static_cast<std::int64_t>(random.whole(0, 6)) - 3;
      const std::int64_t behind = 4 + random.whole(0, 1);
      rim.push_back({aside * close.x - behind * apex.x, aside * close.y - behind * apex.y});
    }
    const auto from_apex = [&](Point p) { return Point{p.x - apex.x, p.y - apex.y}; };
    std::sort(rim.begin(), rim.end(),
              [&](Point p, Point q) { return cross(from_apex(p), from_apex(q)) > 0; });
    // Points on both sides, well away from the line.
    rim.insert(rim.begin(), {-apex.x - apex.y, -apex.y + apex.x});
    rim.push_back({-apex.x + apex.y, -apex.y - apex.x});
    if (cross(from_apex(rim.front()), from_apex(rim[1])) < 0) std::swap(rim.front(), rim.back());
    std::vector<CornersWorld> slivers;
    const auto corner = [](Point p) { return glm::dvec3(p.x, p.y, 5.0); };
    for (std::size_t i = 1; i < rim.size(); ++i) {
      slivers.push_back({corner(apex), corner(rim[i - 1]), corner(rim[i])});
      const double rounded = static_cast<double>(apex.x) * static_cast<double>(rim[i].y) -
                             static_cast<double>(apex.y) * static_cast<double>(rim[i].x);
      const Int128 exact = cross(apex, rim[i]);
      wrong_in_double += (rounded > 0.0) != (exact > 0) || (rounded < 0.0) != (exact < 0);
    }
    const auto [enters, leaves] = hits(slivers, LightRay({0, 0, 0}, {{0, 0, 1}, 0.0}));
    ASSERT_EQ(enters + leaves, 1) << round;
  }
  EXPECT_GT(wrong_in_double, 1000);
}

}  // namespace
}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
#include "shading/light_ray.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

TEST(LightRay, AgreesWithLongDouble) {
  RandomSolids random(1);
  int enters = 0;
  for (int round = 0; round < 40; ++round) {
    const Scene scene = random.scene(3);
    const auto triangles = all_corners(scene);
    for (int i = 0; i < 500; ++i) {
      const glm::dvec3 from = random.cube(2.0);
      const LightPoint light = i % 2 ? LightPoint{random.unit(), 0.0} : LightPoint{random.cube(2.0), 1.0};
      const Crossings truth = crossings(triangles, from, light);
      if (truth.margin < 1e-12L) continue;
      ASSERT_EQ(hits(triangles, LightRay(from, light)), std::pair(truth.enters, truth.leaves));
      enters += truth.enters;
    }
  }
  EXPECT_GT(enters, 1000);
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

// A fan around a point that the rays miss by a few roundings. Plain products give wrong signs here.
TEST(LightRay, CrossesAFanOnceAroundItsMiddle) {
  RandomSolids random(3);
  for (int round = 0; round < 300; ++round) {
    const glm::dvec3 middle(random.within(0.1, 1.0), random.within(0.1, 1.0), 1.0);
    std::vector<CornersWorld> fan;
    const int blades = static_cast<int>(random.whole(5, 9));
    std::vector<glm::dvec3> rim;
    for (int i = 0; i < blades; ++i) {
      const double angle = 6.283185307179586 * (i + random.within(0.1, 0.9)) / blades;
      rim.push_back(middle + random.within(1.0, 2.0) * glm::dvec3(std::cos(angle), std::sin(angle), 0.0));
    }
    for (int i = 0; i < blades; ++i) fan.push_back({middle, rim[i], rim[(i + 1) % blades]});
    for (int i = 0; i < 100; ++i) {
      const glm::dvec3 from(middle.x + 1e-16 * random.within(-4, 4), middle.y + 1e-16 * random.within(-4, 4),
                            0.0);
      const auto [enters, leaves] = hits(fan, LightRay(from, {{0, 0, 1}, 0.0}));
      ASSERT_EQ(std::abs(enters) + std::abs(leaves), 1) << round;
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

// Rays along the edges and through the corners leave a solid as often as they enter it.
TEST(LightRay, EntersAndLeavesASolidAlongItsEdges) {
  const Mesh box = make_box({2.0, 2.0, 2.0}, 2);
  std::vector<CornersWorld> triangles;
  for (const SceneTriangle& t : box.triangles)
    triangles.push_back(
        {box.positions[t.position[0]], box.positions[t.position[1]], box.positions[t.position[2]]});
  int through = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (double a : {-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5})
      for (double b : {-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5})
        for (double sign : {-1.0, 1.0}) {
          glm::dvec3 from, direction(0.0);
          from[axis] = -5.0 * sign;
          from[(axis + 1) % 3] = a;
          from[(axis + 2) % 3] = b;
          direction[axis] = sign;
          const auto [enters, leaves] = hits(triangles, LightRay(from, {direction, 0.0}));
          ASSERT_EQ(enters, leaves) << axis << ' ' << a << ' ' << b;
          const double farthest = std::max(std::abs(a), std::abs(b));
          ASSERT_TRUE(farthest == 1.0 || enters == (farthest < 1.0));
          ASSERT_LE(enters, 1);
          through += enters;
        }
  EXPECT_GT(through, 3 * 2 * 9);
}

}  // namespace
}  // namespace halfway

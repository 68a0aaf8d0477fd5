// SPDX-License-Identifier: Apache-2.0
#include "mesh_files/triangulate.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace halfway {
namespace {

// ---- Oracle: integers and rational numbers, nothing of the code under test

struct Point {
  std::int64_t x, y;
  auto operator<=>(const Point&) const = default;
};
using Outline = std::vector<Point>;
using Triangles = std::vector<Triangulator::Triangle>;

std::int64_t cross(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Twice the signed area.
std::int64_t area(const Outline& outline) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point &a = outline[i], &b = outline[(i + 1) % outline.size()];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum;
}

struct Rational {
  mpq_class x, y;
};

/// Twice the area that two counter-clockwise triangles have in common: clip one by the sides of the other.
mpq_class common_area(const std::array<Point, 3>& a, const std::array<Point, 3>& b) {
  std::vector<Rational> left;
  for (const Point& p : a) left.push_back({mpq_class(p.x), mpq_class(p.y)});
  for (std::size_t side = 0; side < 3 && !left.empty(); ++side) {
    const Point &from = b[side], &to = b[(side + 1) % 3];
    const auto distance = [&](const Rational& p) -> mpq_class {
      return mpq_class(to.x - from.x) * (p.y - from.y) - mpq_class(to.y - from.y) * (p.x - from.x);
    };
    std::vector<Rational> clipped;
    for (std::size_t i = 0; i < left.size(); ++i) {
      const Rational &p = left[i], &q = left[(i + 1) % left.size()];
      const mpq_class d = distance(p), e = distance(q);
      if (sgn(d) >= 0) clipped.push_back(p);
      if (sgn(d) * sgn(e) < 0) {
        const mpq_class t = d / (d - e);
        clipped.push_back({mpq_class(p.x + t * (q.x - p.x)), mpq_class(p.y + t * (q.y - p.y))});
      }
    }
    left = std::move(clipped);
  }
  mpq_class sum = 0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    const Rational &p = left[i], &q = left[(i + 1) % left.size()];
    sum += p.x * q.y - p.y * q.x;
  }
  return sum;
}

/// How often the outline winds around a point that is on no edge; coordinates times `scale`.
int winding(const Outline& outline, std::int64_t x, std::int64_t y, std::int64_t scale) {
  int count = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point a{outline[i].x * scale, outline[i].y * scale};
    const Point& next = outline[(i + 1) % outline.size()];
    const Point b{next.x * scale, next.y * scale};
    if (a.y <= y && b.y > y && cross(a, b, {x, y}) > 0) ++count;
    if (a.y > y && b.y <= y && cross(a, b, {x, y}) < 0) --count;
  }
  return count;
}

std::string text_of(const Outline& outline) {
  std::string text;
  for (const Point& p : outline) text += "(" + std::to_string(p.x) + "," + std::to_string(p.y) + ") ";
  return text;
}

/// The outline in space: x u + y v + w.
struct Plane {
  std::array<int, 3> u, v, w;
};
constexpr Plane c_xy{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}};

std::vector<glm::dvec3> in_space(const Outline& outline, const Plane& plane) {
  std::vector<glm::dvec3> corners;
  for (const Point& p : outline) {
    glm::dvec3 corner;
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      corner[axis] = static_cast<double>(p.x * plane.u[i] + p.y * plane.v[i] + plane.w[i]);
    }
    corners.push_back(corner);
  }
  return corners;
}

/// Expect that the triangles divide the outline: each positive, disjoint insides, the sum of the areas that
/// of the outline, every corner in use.
void expect_divided(const Outline& outline, const Triangles& triangles, bool touches_itself = false) {
  const std::int64_t sign = area(outline) > 0 ? 1 : -1;
  std::int64_t sum = 0;
  std::vector<std::array<Point, 3>> positive;
  std::set<std::uint32_t> used;
  for (const Triangulator::Triangle& t : triangles) {
    std::array<Point, 3> at{outline.at(t[0]), outline.at(t[1]), outline.at(t[2])};
    const std::int64_t twice = sign * cross(at[0], at[1], at[2]);
    ASSERT_GE(twice, touches_itself ? 0 : 1) << text_of(outline);
    used.insert(t.begin(), t.end());
    sum += twice;
    if (sign < 0) std::swap(at[0], at[1]);
    if (twice > 0) positive.push_back(at);
  }
  ASSERT_EQ(sum, sign * area(outline)) << text_of(outline);
  for (std::size_t i = 0; i < positive.size(); ++i) {
    for (std::size_t j = i + 1; j < positive.size(); ++j) {
      ASSERT_EQ(sgn(common_area(positive[i], positive[j])), 0) << text_of(outline);
    }
  }
  if (touches_itself) return;
  ASSERT_EQ(used.size(), outline.size()) << text_of(outline);
  ASSERT_EQ(triangles.size() + 2, outline.size()) << text_of(outline);
}

PolygonKind divide(const Outline& outline, Triangles& triangles, const Plane& plane = c_xy) {
  Triangulator triangulator;
  triangles.clear();
  return triangulator.divide(in_space(outline, plane), triangles);
}

void expect_divides(const Outline& outline, bool touches_itself = false) {
  for (const Plane& plane :
       {c_xy, Plane{{0, 1, 0}, {0, 0, 1}, {1, 2, 3}}, Plane{{2, 1, -1}, {-1, 3, 5}, {-7, 0, 9}},
        Plane{{-1, 0, 4}, {0, -1, 2}, {100, 0, 0}}}) {
    Triangles triangles;
    ASSERT_EQ(divide(outline, triangles, plane), PolygonKind::divided) << text_of(outline);
    expect_divided(outline, triangles, touches_itself);
    // The same outline in the other direction.
    const Outline reversed(outline.rbegin(), outline.rend());
    ASSERT_EQ(divide(reversed, triangles, plane), PolygonKind::divided) << text_of(reversed);
    expect_divided(reversed, triangles, touches_itself);
  }
}

// ---- Shapes

TEST(Triangulate, AConvexPolygonBecomesAFan) {
  Triangles triangles;
  EXPECT_EQ(divide({{0, 0}, {2, 0}, {3, 1}, {2, 2}, {0, 2}}, triangles), PolygonKind::divided);
  EXPECT_EQ(triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
  EXPECT_EQ(divide({{0, 0}, {0, 2}, {2, 2}, {2, 0}}, triangles), PolygonKind::divided);  // clockwise
  EXPECT_EQ(triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Triangulate, TrianglesAreAppended) {
  Triangulator triangulator;
  Triangles triangles{{7, 8, 9}};
  const Outline square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  EXPECT_EQ(triangulator.divide(in_space(square, c_xy), triangles), PolygonKind::divided);
  EXPECT_EQ(triangles.size(), 3u);
  const Outline bow_tie{{0, 0}, {3, 3}, {3, 0}, {0, 2}};
  EXPECT_EQ(triangulator.divide(in_space(bow_tie, c_xy), triangles), PolygonKind::crossing);
  EXPECT_EQ(triangles.size(), 3u);
  EXPECT_EQ(triangles[0], (Triangulator::Triangle{7, 8, 9}));
}

TEST(Triangulate, APolygonOnALineHasNoArea) {
  Triangles triangles;
  for (const Plane& plane : {c_xy, Plane{{2, 1, -1}, {-1, 3, 5}, {-7, 0, 9}}}) {
    EXPECT_EQ(divide({{0, 0}, {1, 1}, {3, 3}, {2, 2}}, triangles, plane), PolygonKind::no_area);
    EXPECT_EQ(divide({{0, 0}, {1, 1}, {0, 0}, {1, 1}}, triangles, plane), PolygonKind::no_area);
    EXPECT_EQ(divide({{5, 5}, {5, 5}, {5, 5}, {5, 5}}, triangles, plane), PolygonKind::no_area);
  }
  EXPECT_TRUE(triangles.empty());
}

TEST(Triangulate, ASkewQuadIsDividedInItsLargestProjection) {
  Triangulator triangulator;
  Triangles triangles;
  // An edge along the axis of projection: two corners are at the same place there.
  const std::vector<glm::dvec3> corners{{0, 0, 0}, {4, 0, 0}, {4, 0, 1}, {0, 4, 0}};
  EXPECT_EQ(triangulator.divide(corners, triangles), PolygonKind::divided);
  EXPECT_EQ(triangles.size(), 2u);
  std::set<std::uint32_t> used;
  for (const auto& t : triangles) used.insert(t.begin(), t.end());
  EXPECT_EQ(used.size(), 4u);
}

TEST(Triangulate, ManyCornersTakeLittleTime) {
  // A convex polygon and a star of 20 000 corners each.
  Outline circle, star;
  for (int i = 0; i < 20'000; ++i) {
    const double angle = 2.0 * M_PI * i / 20'000, radius = i % 2 == 0 ? 1.0 : 0.9;
    circle.push_back({std::llround(8e6 * std::cos(angle)), std::llround(8e6 * std::sin(angle))});
    star.push_back(
        {std::llround(8e6 * radius * std::cos(angle)), std::llround(8e6 * radius * std::sin(angle))});
  }
  for (const Outline& outline : {circle, star}) {
    Triangles triangles;
    ASSERT_EQ(divide(outline, triangles), PolygonKind::divided);
    ASSERT_EQ(triangles.size(), 19'998u);
    std::int64_t sum = 0;
    for (const auto& t : triangles) sum += cross(outline[t[0]], outline[t[1]], outline[t[2]]);
    EXPECT_EQ(sum, area(outline));
  }
}

// ---- Properties over random polygons

/// A random outline without crossings: a random order of lattice points whose crossings are removed by
/// reversing parts, until no two edges touch. Empty if that takes too long.
Outline random_simple(std::mt19937& random, std::size_t corners, int size) {
  std::set<Point> points;
  while (points.size() < corners) {
    points.insert({static_cast<int>(random() % static_cast<unsigned>(size)),
                   static_cast<int>(random() % static_cast<unsigned>(size))});
  }
  Outline outline(points.begin(), points.end());
  std::shuffle(outline.begin(), outline.end(), random);
  const auto sign = [](std::int64_t v) { return (v > 0) - (v < 0); };
  const auto is_on = [&](const Point& a, const Point& b, const Point& p) {
    return cross(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
           std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
  };
  const auto touch = [&](std::size_t i, std::size_t j) {
    const std::size_t n = outline.size();
    const Point &a = outline[i], &b = outline[(i + 1) % n], &c = outline[j], &d = outline[(j + 1) % n];
    if ((i + 1) % n == j) return is_on(a, b, d) || is_on(c, d, a);
    if ((j + 1) % n == i) return is_on(a, b, c) || is_on(c, d, b);
    return is_on(a, b, c) || is_on(a, b, d) || is_on(c, d, a) || is_on(c, d, b) ||
           (sign(cross(a, b, c)) * sign(cross(a, b, d)) < 0 &&
            sign(cross(c, d, a)) * sign(cross(c, d, b)) < 0);
  };
  for (int round = 0; round < 200; ++round) {
    bool is_simple = true;
    for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
      for (std::size_t j = i + 1; j < outline.size(); ++j) {
        if (!touch(i, j)) continue;
        is_simple = false;
        std::reverse(outline.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                     outline.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        if (random() % 4 == 0) std::shuffle(outline.begin(), outline.begin() + 3, random);
      }
    }
    if (is_simple) return outline;
  }
  return {};
}

TEST(Triangulate, DividesRandomOutlinesOnSmallAndLargeLattices) {
  std::mt19937 random(3);
  int divided = 0;
  for (int trial = 0; trial < 600; ++trial) {
    // Small lattices give many corners on lines through others.
    const std::size_t corners = 4 + random() % 22;
    const Outline outline = random_simple(random, corners, trial % 2 == 0 ? 7 : 1000);
    if (outline.empty()) continue;
    ++divided;
    ASSERT_NO_FATAL_FAILURE(expect_divides(outline));
  }
  EXPECT_GT(divided, 400);
}

/// The least and the greatest winding number of an outline on the lattice 0 .. size - 1, from points between
/// the lines through its corners. `scale` decides how close the points are.
std::pair<int, int> windings(const Outline& outline, std::int64_t size, std::int64_t scale) {
  int low = 0, high = 0;
  for (std::int64_t y = 1; y < (size - 1) * scale; y += 2) {
    for (std::int64_t x = 1; x < (size - 1) * scale; x += 2) {
      bool is_on_edge = false;
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const Point &a = outline[i], &b = outline[(i + 1) % outline.size()];
        is_on_edge |= a != b && cross({a.x * scale, a.y * scale}, {b.x * scale, b.y * scale}, {x, y}) == 0;
      }
      if (is_on_edge) continue;
      const int w = winding(outline, x, y, scale);
      low = std::min(low, w);
      high = std::max(high, w);
    }
  }
  return {low, high};
}

bool is_on_line(const Outline& outline) {
  for (const Point& a : outline)
    for (const Point& b : outline)
      for (const Point& c : outline)
        if (cross(a, b, c) != 0) return false;
  return true;
}

/// True if two edges cross inside both.
bool has_crossing(const Outline& outline) {
  const auto sign = [](std::int64_t v) { return (v > 0) - (v < 0); };
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const Point &a = outline[i], &b = outline[(i + 1) % n], &c = outline[j], &d = outline[(j + 1) % n];
      if (sign(cross(a, b, c)) * sign(cross(a, b, d)) < 0 && sign(cross(c, d, a)) * sign(cross(c, d, b)) < 0)
        return true;
    }
  }
  return false;
}

/// Expect what the winding number decides: an outline with the numbers 0 and 1 everywhere, or 0 and -1, is
/// divided; any other is refused. With `lenient`, an outline with a crossing may be refused too.
PolygonKind expect_decided(const Outline& outline, std::int64_t size, bool lenient) {
  constexpr std::int64_t c_scale = 97;
  Triangles triangles;
  const PolygonKind kind = divide(outline, triangles);
  if (is_on_line(outline)) {
    EXPECT_EQ(kind, PolygonKind::no_area) << text_of(outline);
    return kind;
  }
  const auto [low, high] = windings(outline, size, c_scale);
  if (high - low != 1) {
    EXPECT_EQ(kind, PolygonKind::crossing) << text_of(outline);
  } else if (kind == PolygonKind::divided) {
    expect_divided(outline, triangles, true);
  } else {
    EXPECT_EQ(kind, PolygonKind::crossing) << text_of(outline);
    EXPECT_TRUE(lenient && has_crossing(outline)) << text_of(outline);
  }
  return kind;
}

TEST(Triangulate, DecidesEveryOutlineOfFiveCornersOnASmallLattice) {
  constexpr std::size_t c_size = 3, c_places = c_size * c_size;
  std::array<int, 3> kinds{};
  // The first corner is at a corner and at the middle of an edge of the lattice.
  for (std::size_t code = 0; code < 2 * c_places * c_places * c_places * c_places; ++code) {
    Outline outline;
    std::size_t left = code;
    for (int i = 0; i < 5; ++i, left /= c_places) {
      const auto place = static_cast<std::int64_t>(left % c_places);
      outline.push_back({place % 3, place / 3});
    }
    std::reverse(outline.begin(), outline.end());
    ++kinds.at(static_cast<std::size_t>(expect_decided(outline, c_size, false)));
    ASSERT_FALSE(::testing::Test::HasFailure());
  }
  EXPECT_GT(*std::min_element(kinds.begin(), kinds.end()), 100);
}

TEST(Triangulate, DecidesRandomOutlinesThatTouchAndCrossThemselves) {
  std::mt19937 random(7);
  std::array<int, 3> kinds{};
  for (int trial = 0; trial < 500; ++trial) {
    const unsigned size = 3 + random() % 2;
    const std::size_t corners = 6 + random() % 4;
    Outline outline;
    while (outline.size() < corners) {
      if (outline.size() >= 2 && random() % 3 == 0) {
        outline.push_back(outline[random() % outline.size()]);
      } else {
        outline.push_back(
            {static_cast<std::int64_t>(random() % size), static_cast<std::int64_t>(random() % size)});
      }
    }
    ++kinds.at(static_cast<std::size_t>(expect_decided(outline, size, true)));
    ASSERT_FALSE(::testing::Test::HasFailure());
  }
  EXPECT_GT(kinds[0], 100);
  EXPECT_GT(kinds[2], 100);
}

/// Random outlines with holes on bridges.
TEST(Triangulate, DividesRandomOutlinesWithHoles) {
  std::mt19937 random(5);
  int with_holes = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Outline outer = random_simple(random, 4 + random() % 8, 9);
    if (outer.empty()) continue;
    if (area(outer) < 0) std::reverse(outer.begin(), outer.end());
    for (Point& p : outer) p = {p.x * 12, p.y * 12};
    // A triangle inside one triangle of the outline, connected to a corner of it.
    Triangles triangles;
    ASSERT_EQ(divide(outer, triangles), PolygonKind::divided);
    const Triangulator::Triangle t = triangles[random() % triangles.size()];
    const Point a = outer[t[0]], b = outer[t[1]], c = outer[t[2]];
    const auto within = [&](int i, int j, int k) {
      return Point{(i * a.x + j * b.x + k * c.x) / 6, (i * a.y + j * b.y + k * c.y) / 6};
    };
    const Point p = within(4, 1, 1), q = within(1, 4, 1), r = within(1, 1, 4);
    Outline holed(outer.begin(), outer.begin() + t[0] + 1);
    for (const Point& corner : {p, r, q, p}) holed.push_back(corner);  // clockwise
    holed.insert(holed.end(), outer.begin() + t[0], outer.end());
    std::rotate(holed.begin(), holed.begin() + static_cast<std::ptrdiff_t>(random() % holed.size()),
                holed.end());
    ASSERT_EQ(area(holed), area(outer) - cross(p, q, r));
    ASSERT_NO_FATAL_FAILURE(expect_divides(holed, true));
    ++with_holes;
  }
  EXPECT_GT(with_holes, 150);
}

// ---- Exact signs

TEST(Orientation, IsExactForDoublesOfAnySize) {
  std::mt19937_64 random(6);
  int zeros = 0, narrow = 0, bits = 24;
  const auto any = [&](int range) {
    const std::int64_t digits = static_cast<std::int64_t>(random() % (std::uint64_t{1} << bits));
    return std::ldexp(static_cast<double>(digits - (std::int64_t{1} << (bits - 1))),
                      static_cast<int>(random() % static_cast<unsigned>(range)) - range / 2 - bits);
  };
  for (int trial = 0; trial < 200'000; ++trial) {
    const int range = trial % 2 == 0 ? 250 : 8;
    bits = trial % 3 == 0 ? 24 : 53;
    std::array<double, 6> v{};
    for (double& x : v) x = any(range);
    if (trial % 4 >= 2) {  // nearly on a line, or exactly
      const auto t = static_cast<double>(static_cast<int>(random() % 9) - 4);
      for (std::size_t i = 0; i < 2; ++i) v[4 + i] = v[i] + t * (v[2 + i] - v[i]);
    }
    if (trial % 5 == 0) {
      // Two points on a line through the origin, and one so close to it that double cannot tell.
      for (std::size_t i = 0; i < 2; ++i) {
        v[i] = any(8);
        v[2 + i] = 2.0 * v[i];
        v[4 + i] = std::ldexp(any(8), -52);
      }
    }
    const auto exact = [&](std::size_t i) { return mpq_class(v[i]); };
    const mpq_class wanted =
        (exact(0) - exact(4)) * (exact(3) - exact(5)) - (exact(1) - exact(5)) * (exact(2) - exact(4));
    const auto point = [&](std::size_t i) { return PlanePoint{v[i], v[i + 1]}; };
    ASSERT_EQ(orientation(point(0), point(2), point(4)), sgn(wanted));
    zeros += sgn(wanted) == 0;
    narrow += trial % 4 >= 2 && sgn(wanted) != 0;
  }
  EXPECT_GT(zeros, 1000);
  EXPECT_GT(narrow, 1000);
}

TEST(ExactSum, HasTheSignOfTheLastBit) {
  ExactSum sum;
  for (const double term : {0x1p255, 1.0, -0x1p255, 0x1p-298, -1.0}) sum.add(term);
  EXPECT_EQ(sum.sign(), 1);
  EXPECT_EQ(sum.value(), 0x1p-298);
  sum.add(-0x1p-298);
  EXPECT_EQ(sum.sign(), 0);
}

}  // namespace
}  // namespace halfway

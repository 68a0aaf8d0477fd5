// SPDX-License-Identifier: Apache-2.0
#include "shading/arc.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "shading/test/exact_turns.hpp"

namespace halfway {
namespace {

constexpr double c_bound = 3e-15;  // as in arc.hpp; the largest error seen here is 1.9e-15

double largest_error(const CosineArc& arc, const std::array<double, 9>& expected) {
  double largest = 0.0;
  for (std::size_t i = 0; i < 9; ++i) {
    const double error = std::abs(arc.at(static_cast<double>(i) / 8.0) - expected[i]);
    if (!(error <= largest)) largest = error;  // keeps NaN
  }
  return largest;
}

/// Angles close to 0, by decades.
const std::vector<double> c_small{1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8,
                                  1e-7,  1e-6,  1e-5,  1e-4,  1e-3,  1e-2,  0.1,   1.0};

void expect_sane(const CosineArc& arc) {
  ASSERT_TRUE(arc.amplitude >= 0.0 && arc.amplitude <= 1.0) << arc.amplitude;
  ASSERT_TRUE(arc.sweep >= 0.0 && arc.sweep <= std::numbers::pi) << arc.sweep;
  ASSERT_LE(std::abs(0.5 * arc.sweep - arc.phase), std::numbers::pi) << arc.sweep << ' ' << arc.phase;
}

void record(const std::string& name, double value) {
  testing::Test::RecordProperty(name, fmt::format("{:.3g}", value));
}

// Every other pair has a fixed v.
TEST(Arc, AnyPairsOfDirections) {
  Directions random(2);
  double largest = 0.0, ends = 0.0;
  for (int i = 0; i < 1'500'000; ++i) {
    const bool is_fixed = i % 2 == 0;
    const glm::dvec3 u1 = random.any(), u2 = random.any(), v1 = random.any();
    const glm::dvec3 v2 = is_fixed ? v1 : random.any();
    if (glm::dot(v1, v2) < -0.999) continue;
    const CosineArc arc = is_fixed ? cosine_arc(u1, u2, v1) : cosine_arc(u1, u2, v1, v2);
    ASSERT_NO_FATAL_FAILURE(expect_sane(arc));
    ends =
        std::max({ends, std::abs(arc.at(0.0) - glm::dot(u1, v1)), std::abs(arc.at(1.0) - glm::dot(u2, v2))});
    if (arc.sweep > std::numbers::pi - 0.01) continue;
    largest = std::max(
        largest, std::sin(arc.sweep) * largest_error(arc, expected_cosines<long double>(u1, u2, v1, v2)));
  }
  record("largest_error_times_sin_sweep", largest);
  record("largest_error_at_ends", ends);
  EXPECT_LT(largest, c_bound);
  EXPECT_LT(ends, c_bound);
}

// If two directions are closer than 1e-13 to opposite, their plane is uncertain in the eighth digit. If both
// vectors turn, the arc depends on their rounding, and it is less certain the closer it is to half a turn.
void expect_arc(glm::dvec3 u1, glm::dvec3 u2, glm::dvec3 v1, glm::dvec3 v2, bool is_known = true) {
  const bool still = v1 == v2;
  const CosineArc arc = still ? cosine_arc(u1, u2, v1) : cosine_arc(u1, u2, v1, v2);
  expect_sane(arc);
  EXPECT_NEAR(arc.at(0.0), glm::dot(u1, v1), c_bound);
  EXPECT_NEAR(arc.at(1.0), glm::dot(u2, v2), c_bound);
  if (!is_known) return;
  EXPECT_LE(largest_error(arc, expected_cosines<BigReal>(u1, u2, v1, v2)),
            still ? c_bound : c_bound / std::sin(arc.sweep));
}

TEST(Arc, SmallTurnsAndAlmostHalfTurns) {
  Directions random(4);
  for (const double angle : c_small)
    for (int i = 0; i < 100; ++i) {
      SCOPED_TRACE(angle);
      const bool known = angle >= 1e-13;
      const glm::dvec3 u1 = random.any(), v1 = random.any(), opposed = random.at(u1, angle, true);
      expect_arc(u1, random.at(u1, angle), v1, v1);
      expect_arc(u1, random.at(u1, 0.8), v1, random.at(v1, angle));
      expect_arc(u1, opposed, v1, v1, known);
      // If both vectors turn, they are opposite only after u2 is turned back.
      const glm::dvec3 v2 = random.at(v1, 0.7);
      const auto ahead =
          turned_back(Vector<long double>(opposed), Vector<long double>(v2), Vector<long double>(v1));
      expect_arc(u1, {double(ahead.x), double(ahead.y), double(ahead.z)}, v1, v2, known);
      expect_arc(u1, random.at(u1, 1.0), v1, random.at(v1, angle, true), known);
      // u is constant: relative to v it turns by the same angle in the other direction.
      expect_arc(v1, v1, u1, opposed, false);
    }
}

TEST(Arc, SlerpMatchesEighths) {
  Directions random(3);
  for (int i = 0; i < 20'000; ++i) {
    const glm::dvec3 u1 = random.any();
    const glm::dvec3 u2 = random.at(u1, c_small[random.below(c_small.size())], random.below(2));
    const Vector<BigReal> a(u1), b(u2);
    const Vector<BigReal> sum = a + b;
    if (static_cast<double>(dot(sum, sum)) < 1e-28) continue;
    const auto expected = eighths(a, b);
    for (std::size_t k = 0; k < 9; ++k) {
      const glm::dvec3 u = slerp(u1, u2, static_cast<double>(k) / 8.0);
      ASSERT_NEAR(u.x, static_cast<double>(expected[k].x), 2e-15) << k;
      ASSERT_NEAR(u.y, static_cast<double>(expected[k].y), 2e-15) << k;
      ASSERT_NEAR(u.z, static_cast<double>(expected[k].z), 2e-15) << k;
    }
    // The amplitude of a direction within the turn is 1, and never more.
    ASSERT_NO_FATAL_FAILURE(expect_sane(cosine_arc(u1, u2, slerp(u1, u2, 0.5))));
  }
}

TEST(Arc, OpposedEndsTurnThroughTheMiddle) {
  Directions random(8);
  int opposed = 0;
  for (int i = 0; i < 100'000; ++i) {
    const glm::dvec3 u1 = random.any(), v = random.any(), middle = random.any();
    const CosineArc arc = cosine_arc(u1, -u1, v, {.u = middle});
    ASSERT_NO_FATAL_FAILURE(expect_sane(arc));
    const glm::dvec3 through = glm::normalize(middle - glm::dot(middle, u1) * u1);
    if (std::abs(glm::dot(middle, u1)) > 0.99) continue;
    ASSERT_EQ(arc.sweep, std::numbers::pi);
    ASSERT_NEAR(arc.at(0.0), glm::dot(u1, v), 1e-15);
    ASSERT_NEAR(arc.at(0.5), glm::dot(through, v), 2e-14);
    ASSERT_NEAR(arc.at(1.0), -glm::dot(u1, v), 1e-15);
    const glm::dvec3 half = slerp(u1, -u1, 0.5, middle);
    ASSERT_NEAR(glm::dot(half, through), 1.0, 1e-14);
    // v turns by pi through the middle: about the axis perpendicular to u1 and `through`.
    const glm::dvec3 axis = glm::cross(u1, through), w1 = random.any(), w2 = random.any();
    const CosineArc pair = cosine_arc(w1, w2, u1, -u1, {.v = middle});
    const CosineArc same = cosine_arc(w1, 2.0 * glm::dot(axis, w2) * axis - w2, u1);
    for (double t : {0.0, 0.3, 0.5, 1.0}) {
      ASSERT_NEAR(pair.at(t), same.at(t), 2e-14 / std::sin(pair.sweep)) << t;
    }
    // u2 is opposite to u1 after v's rotation is undone. The middle of u is given without that rotation.
    const glm::dvec3 v2 = slerp(v, random.any(), 0.4);
    const glm::dvec3 vm = slerp(v, v2, 0.5);
    const auto ahead = [&](glm::dvec3 x, glm::dvec3 to) {
      const Vector<long double> r =
          turned_back(Vector<long double>(x), Vector<long double>(to), Vector<long double>(v));
      return glm::dvec3(static_cast<double>(r.x), static_cast<double>(r.y), static_cast<double>(r.z));
    };
    const glm::dvec3 u2 = ahead(-u1, v2), um = ahead(through, vm);
    const CosineArc both = cosine_arc(u1, u2, v, v2, {.u = um});
    ASSERT_NEAR(both.at(1.0), glm::dot(u2, v2), 2e-15);
    if (both.sweep == std::numbers::pi) {
      ASSERT_NEAR(both.at(0.5), glm::dot(um, vm), 1e-13);
      ++opposed;
    }
  }
  EXPECT_GT(opposed, 10'000);
}

TEST(Arc, OpposedEndsWithoutAMiddleUseOnePlaneForAll) {
  Directions random(9);
  for (int i = 0; i < 100'000; ++i) {
    glm::dvec3 u1 = random.any();
    if (i < 6) u1 = glm::dvec3(0.0), u1[i / 2] = i % 2 ? -1.0 : 1.0;
    const glm::dvec3 v = random.any();
    // The middle may be missing, parallel to the ends, or not a number.
    const std::array<glm::dvec3, 4> middles{glm::dvec3(0.0), u1, -u1,
                                            glm::dvec3(std::numeric_limits<double>::quiet_NaN())};
    for (const glm::dvec3& middle : middles) {
      const CosineArc arc = cosine_arc(u1, -u1, v, {.u = middle, .v = middle});
      ASSERT_NO_FATAL_FAILURE(expect_sane(arc));
      for (double t : {0.0, 0.25, 0.5, 1.0}) {
        const glm::dvec3 u = slerp(u1, -u1, t, middle);
        ASSERT_NEAR(glm::dot(u, u), 1.0, 1e-15);
        ASSERT_EQ(u, slerp(u1, -u1, t));
        ASSERT_NEAR(arc.at(t), glm::dot(u, v), 2e-15);
      }
      const CosineArc pair = cosine_arc(v, random.any(), u1, -u1, {.u = middle, .v = middle});
      ASSERT_NO_FATAL_FAILURE(expect_sane(pair));
      ASSERT_NEAR(pair.at(0.0), glm::dot(u1, v), 2e-15);
    }
  }
}

// H = (L + V)/|L + V| is 0/0 if light and eye are opposite. For any value that replaces it, the highlight
// must be zero.
TEST(Arc, HalfwayVectorOfZeroOverZeroGivesNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  const glm::dvec3 n1{1, 0, 0}, n2{0, 1, 0};
  for (const glm::dvec3& none :
       {glm::dvec3(0.0), glm::dvec3(nan), glm::dvec3(0, nan, 0), glm::dvec3(infinity, 0, 0),
        glm::dvec3(1e200), glm::dvec3(1e-200), glm::dvec3(0.1, 0.2, 0.3)}) {
    for (const CosineArc& arc :
         {cosine_arc(none, n2, n1), cosine_arc(n1, none, n1), cosine_arc(n1, n2, none),
          cosine_arc(none, n2, n1, n2), cosine_arc(n1, none, n1, n2), cosine_arc(n1, n2, none, n2),
          cosine_arc(n1, n2, n1, none), cosine_arc(none, none, none, none)}) {
      EXPECT_EQ(arc.amplitude, 0.0);
      EXPECT_EQ(arc.sweep, 0.0);
      EXPECT_EQ(arc.phase, 0.0);
    }
    EXPECT_EQ(slerp(none, n2, 0.5), glm::dvec3(0.0));
    EXPECT_EQ(slerp(n1, none, 0.5), glm::dvec3(0.0));
    // As a middle it counts as unknown.
    EXPECT_EQ(slerp(n1, -n1, 0.5, none), slerp(n1, -n1, 0.5));
    EXPECT_EQ(cosine_arc(n1, -n1, n2, {none, none}).amplitude, cosine_arc(n1, -n1, n2).amplitude);
  }
}

TEST(Arc, SlightlyOffUnitLengthIsWithinItsWeight) {
  Directions random(14);
  for (int i = 0; i < 100'000; ++i) {
    const double a = 1.0 + 1e-7 * random.uniform(), b = 1.0 + 1e-7 * random.uniform();
    const glm::dvec3 u1 = random.any(), u2 = random.any(), v1 = random.any(), v2 = random.any();
    const CosineArc exact = cosine_arc(u1, u2, v1, v2), scaled = cosine_arc(a * u1, b * u2, b * v1, a * v2);
    ASSERT_NO_FATAL_FAILURE(expect_sane(scaled));
    ASSERT_NEAR(scaled.at(0.0), exact.at(0.0), 5e-7);
    ASSERT_NEAR(scaled.at(1.0), exact.at(1.0), 5e-7);
  }
}

}  // namespace
}  // namespace halfway

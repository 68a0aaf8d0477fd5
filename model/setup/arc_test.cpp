// SPDX-License-Identifier: Apache-2.0
#include "setup/arc.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <mpfr.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace halfway {
namespace {

constexpr double c_pi = std::numbers::pi;
constexpr double c_bound = 3e-15;  // arc.hpp's; 1.9e-15 is the most that is seen here

/// 250 bits: sums of opposed vectors, and quotients by them, lose nothing here.
class Real {
 public:
  Real(double v = 0.0) {
    mpfr_init2(v_, 250);
    mpfr_set_d(v_, v, MPFR_RNDN);
  }
  Real(const Real& other) : Real() { mpfr_set(v_, other.v_, MPFR_RNDN); }
  Real& operator=(const Real& other) {
    mpfr_set(v_, other.v_, MPFR_RNDN);
    return *this;
  }
  ~Real() { mpfr_clear(v_); }
  explicit operator double() const { return mpfr_get_d(v_, MPFR_RNDN); }
  friend Real operator+(const Real& a, const Real& b) { return apply(mpfr_add, a, b); }
  friend Real operator-(const Real& a, const Real& b) { return apply(mpfr_sub, a, b); }
  friend Real operator*(const Real& a, const Real& b) { return apply(mpfr_mul, a, b); }
  friend Real operator/(const Real& a, const Real& b) { return apply(mpfr_div, a, b); }
  friend Real sqrt(const Real& a) {
    Real r;
    mpfr_sqrt(r.v_, a.v_, MPFR_RNDN);
    return r;
  }

 private:
  template <class Operation>
  static Real apply(Operation operation, const Real& a, const Real& b) {
    Real r;
    operation(r.v_, a.v_, b.v_, MPFR_RNDN);
    return r;
  }
  mpfr_t v_;
};

// The same directions by other means, without an angle: half way between two unit vectors is their sum, made
// unit; and the rotation from one to another is two half turns.

template <class R>
struct Vector {
  R x, y, z;
  Vector(R x_, R y_, R z_) : x(x_), y(y_), z(z_) {}
  explicit Vector(glm::dvec3 v) : x(v.x), y(v.y), z(v.z) {}
  friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector operator*(const R& s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend R dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
};

template <class R>
Vector<R> unit(const Vector<R>& v) {
  using std::sqrt;
  return (R(1.0) / sqrt(dot(v, v))) * v;
}

/// The great circle from a to b at t = 0, 1/8, 2/8 ... 1. a and b are not opposed.
template <class R>
std::array<Vector<R>, 9> eighths(const Vector<R>& from, const Vector<R>& to) {
  const Vector<R> a = unit(from), b = unit(to);
  const auto halve = [](const Vector<R>& p, const Vector<R>& q) { return unit(p + q); };
  const Vector<R> middle = halve(a, b), left = halve(a, middle), right = halve(middle, b);
  return {a,     halve(a, left),  left, halve(left, middle), middle, halve(middle, right),
          right, halve(right, b), b};
}

/// x after half a turn about a unit axis.
template <class R>
Vector<R> half_turn(const Vector<R>& x, const Vector<R>& axis) {
  return R(2.0) * dot(axis, x) * axis - x;
}

/// Half a turn about v1, then about the middle between v1 and v2, takes v1 to v2 and leaves v1 x v2 as it is:
/// the rotation v1 -> v2. Here it is undone.
template <class R>
Vector<R> turned_back(const Vector<R>& x, const Vector<R>& v1, const Vector<R>& v2) {
  const Vector<R> a = unit(v1), middle = unit(a + unit(v2));
  return half_turn(half_turn(x, middle), a);
}

/// Cosines at the eighths: v held at v1.
template <class R>
std::array<double, 9> expected_cosines(glm::dvec3 u1, glm::dvec3 u2, glm::dvec3 v1, glm::dvec3 v2) {
  const Vector<R> v = unit(Vector<R>(v1));
  const Vector<R> u2_back =
      v1 == v2 ? Vector<R>(u2) : turned_back(unit(Vector<R>(u2)), Vector<R>(v1), Vector<R>(v2));
  std::array<double, 9> result;
  const auto u = eighths(Vector<R>(u1), u2_back);
  for (std::size_t i = 0; i < 9; ++i) result[i] = static_cast<double>(dot(u[i], v));
  return result;
}

double largest_error(const CosineArc& arc, const std::array<double, 9>& expected) {
  double largest = 0.0;
  for (std::size_t i = 0; i < 9; ++i) {
    const double error = std::abs(arc.at(static_cast<double>(i) / 8.0) - expected[i]);
    if (!(error <= largest)) largest = error;  // NaN stays
  }
  return largest;
}

class Directions {
 public:
  explicit Directions(unsigned seed) : random_(seed) {}
  double uniform() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random_); }
  std::size_t below(std::size_t n) { return random_() % n; }
  glm::dvec3 any() {
    for (;;) {
      const glm::dvec3 v{uniform(), uniform(), uniform()};
      const double length2 = glm::dot(v, v);
      if (length2 > 0.01 && length2 <= 1.0) return glm::normalize(v);
    }
  }
  /// At an angle from u, to the last bit of its components: pi - 1e-12 is not pi.
  glm::dvec3 at(glm::dvec3 u, double angle, bool from_opposed = false) {
    const Vector<long double> a = unit(Vector<long double>(u)), other(any());
    const Vector<long double> tangent = unit(other - dot(other, a) * a);
    const long double cosine = std::cos(static_cast<long double>(angle)) * (from_opposed ? -1 : 1);
    const Vector<long double> v = cosine * a + std::sin(static_cast<long double>(angle)) * tangent;
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
  }

 private:
  std::mt19937 random_;
};

/// Angles near 0 by decades.
const std::vector<double> c_small{1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8,
                                  1e-7,  1e-6,  1e-5,  1e-4,  1e-3,  1e-2,  0.1,   1.0};

void expect_sane(const CosineArc& arc) {
  ASSERT_TRUE(arc.amplitude >= 0.0 && arc.amplitude <= 1.0) << arc.amplitude;
  ASSERT_TRUE(arc.sweep >= 0.0 && arc.sweep <= c_pi) << arc.sweep;
  ASSERT_LE(std::abs(0.5 * arc.sweep - arc.phase), c_pi) << arc.sweep << ' ' << arc.phase;
}

void record(const std::string& name, double value) {
  testing::Test::RecordProperty(name, fmt::format("{:.3g}", value));
}

TEST(Arc, AnyDirectionsWithOneHeldFixed) {
  Directions random(1);
  double largest = 0.0;
  for (int i = 0; i < 1'000'000; ++i) {
    const glm::dvec3 u1 = random.any(), u2 = random.any(), v = random.any();
    if (glm::dot(u1, u2) < -0.999) continue;
    const CosineArc arc = cosine_arc(u1, u2, v);
    ASSERT_NO_FATAL_FAILURE(expect_sane(arc));
    largest = std::max(largest, largest_error(arc, expected_cosines<long double>(u1, u2, v, v)));
  }
  record("largest_error", largest);
  EXPECT_LT(largest, c_bound);
}

TEST(Arc, AnyPairsOfDirections) {
  Directions random(2);
  double largest = 0.0, ends = 0.0;
  for (int i = 0; i < 1'000'000; ++i) {
    const glm::dvec3 u1 = random.any(), u2 = random.any(), v1 = random.any(), v2 = random.any();
    if (glm::dot(v1, v2) < -0.999) continue;
    const CosineArc arc = cosine_arc(u1, u2, v1, v2);
    ASSERT_NO_FATAL_FAILURE(expect_sane(arc));
    ends =
        std::max({ends, std::abs(arc.at(0.0) - glm::dot(u1, v1)), std::abs(arc.at(1.0) - glm::dot(u2, v2))});
    if (arc.sweep > c_pi - 0.01) continue;
    largest = std::max(
        largest, std::sin(arc.sweep) * largest_error(arc, expected_cosines<long double>(u1, u2, v1, v2)));
  }
  record("largest_error_times_sin_sweep", largest);
  record("largest_error_at_ends", ends);
  EXPECT_LT(largest, c_bound);
  EXPECT_LT(ends, c_bound);
}

TEST(Arc, SlerpGoesByEighths) {
  Directions random(3);
  for (int i = 0; i < 20'000; ++i) {
    const glm::dvec3 u1 = random.any();
    const glm::dvec3 u2 = random.at(u1, c_small[random.below(c_small.size())], random.below(2));
    const Vector<Real> a(u1), b(u2);
    const Vector<Real> sum = a + b;
    if (static_cast<double>(dot(sum, sum)) < 1e-28) continue;
    const auto expected = eighths(a, b);
    for (std::size_t k = 0; k < 9; ++k) {
      const glm::dvec3 u = slerp(u1, u2, static_cast<double>(k) / 8.0);
      ASSERT_NEAR(u.x, static_cast<double>(expected[k].x), 2e-15) << k;
      ASSERT_NEAR(u.y, static_cast<double>(expected[k].y), 2e-15) << k;
      ASSERT_NEAR(u.z, static_cast<double>(expected[k].z), 2e-15) << k;
    }
  }
}

TEST(Arc, GammaToZero) {
  Directions random(4);
  double largest = 0.0, sweep = 0.0;
  for (double gamma : c_small)
    for (int i = 0; i < 1500; ++i) {
      const glm::dvec3 u1 = random.any(), u2 = random.at(u1, gamma), v1 = random.any();
      const glm::dvec3 v2 = i % 2 ? v1 : random.at(v1, gamma);
      const CosineArc arc = i % 2 ? cosine_arc(u1, u2, v1) : cosine_arc(u1, u2, v1, v2);
      ASSERT_NO_FATAL_FAILURE(expect_sane(arc));
      largest = std::max(largest, largest_error(arc, expected_cosines<Real>(u1, u2, v1, v2)));
      if (i % 2 == 0) continue;
      // The angle has its digits too, as far as the ends' own components give them.
      const double off = std::abs(arc.sweep - gamma);
      sweep = std::max(sweep, off);
    }
  record("largest_error", largest);
  record("largest_error_of_sweep", sweep);
  EXPECT_LT(largest, c_bound);
  EXPECT_LT(sweep, c_bound);
}

TEST(Arc, GammaToPi) {
  Directions random(5);
  double fixed = 0.0, pair = 0.0, sweep = 0.0, ends = 0.0;
  for (double left : c_small)
    for (int i = 0; i < 1500; ++i) {
      const glm::dvec3 u1 = random.any(), u2 = random.at(u1, left, true), v = random.any();
      const CosineArc still = cosine_arc(u1, u2, v);
      ASSERT_NO_FATAL_FAILURE(expect_sane(still));
      ends = std::max(
          {ends, std::abs(still.at(0.0) - glm::dot(u1, v)), std::abs(still.at(1.0) - glm::dot(u2, v))});
      sweep = std::max(sweep, std::abs(still.sweep - (c_pi - left)));
      if (left >= 1e-13) fixed = std::max(fixed, largest_error(still, expected_cosines<Real>(u1, u2, v, v)));
      // A u that stands still, seen from a v that turns nearly half round, turns as much the other way.
      const CosineArc turned = cosine_arc(v, v, u1, u2);
      ASSERT_NO_FATAL_FAILURE(expect_sane(turned));
      ends = std::max(
          {ends, std::abs(turned.at(0.0) - glm::dot(v, u1)), std::abs(turned.at(1.0) - glm::dot(v, u2))});
      // And a pair whose u2 comes to be opposed only when it is turned back.
      const glm::dvec3 v2 = random.at(v, 0.7);
      const Vector<long double> u2_ahead =
          turned_back(Vector<long double>(u2), Vector<long double>(v2), Vector<long double>(v));
      const glm::dvec3 u2_turned{static_cast<double>(u2_ahead.x), static_cast<double>(u2_ahead.y),
                                 static_cast<double>(u2_ahead.z)};
      const CosineArc arc = cosine_arc(u1, u2_turned, v, v2);
      ASSERT_NO_FATAL_FAILURE(expect_sane(arc));
      ends = std::max(
          {ends, std::abs(arc.at(0.0) - glm::dot(u1, v)), std::abs(arc.at(1.0) - glm::dot(u2_turned, v2))});
      if (left >= 1e-13)
        pair =
            std::max(pair, std::sin(left) * largest_error(arc, expected_cosines<Real>(u1, u2_turned, v, v2)));
    }
  record("largest_error_fixed", fixed);
  record("largest_error_pair_times_sin_sweep", pair);
  record("largest_error_at_ends", ends);
  record("largest_error_of_sweep", sweep);
  EXPECT_LT(fixed, c_bound);
  EXPECT_LT(pair, c_bound);
  EXPECT_LT(ends, c_bound);
  EXPECT_LT(sweep, c_bound);
}

TEST(Arc, GammaVToPi) {
  Directions random(6);
  double largest = 0.0, ends = 0.0;
  for (double left : c_small)
    for (int i = 0; i < 1500; ++i) {
      const glm::dvec3 u1 = random.any(), u2 = random.any(), v1 = random.any();
      const glm::dvec3 v2 = random.at(v1, left, true);
      const CosineArc arc = cosine_arc(u1, u2, v1, v2);
      ASSERT_NO_FATAL_FAILURE(expect_sane(arc));
      ends = std::max(
          {ends, std::abs(arc.at(0.0) - glm::dot(u1, v1)), std::abs(arc.at(1.0) - glm::dot(u2, v2))});
      if (left >= 1e-13)
        largest = std::max(largest,
                           std::sin(arc.sweep) * largest_error(arc, expected_cosines<Real>(u1, u2, v1, v2)));
    }
  record("largest_error_times_sin_sweep", largest);
  record("largest_error_at_ends", ends);
  EXPECT_LT(largest, c_bound);
  EXPECT_LT(ends, c_bound);
}

// Equations 12 to 16 of the spherical paper as they are printed.
CosineArc arc_as_published(glm::dvec3 u1, glm::dvec3 u2, glm::dvec3 v1, glm::dvec3 v2) {
  const glm::dvec3 c = glm::cross(v1, v2);
  const double cos_gamma_v = glm::dot(v1, v2);
  const glm::dvec3 u2_back = cos_gamma_v * u2 - glm::cross(c, u2) + glm::dot(c, u2) / (1.0 + cos_gamma_v) * c;
  const double cos_gamma = glm::dot(u1, u2_back), gamma = std::acos(cos_gamma);
  const double cos1 = glm::dot(u1, v1), cos2 = glm::dot(u2, v2);
  const double b = (cos2 - cos1 * cos_gamma) / std::sin(gamma);
  return {std::hypot(cos1, b), gamma, std::atan2(b, cos1)};
}

// How far the printed quotients are off, beside ours, decade by decade, and how often they are no number.
TEST(Arc, PublishedQuotientsBreakWhereTheseHold) {
  Directions random(7);
  struct Largest {
    double published = 0.0, ours = 0.0;
    int not_numbers = 0;
  };
  const auto measure = [&](const char* name, double angle, auto&& ends_for) {
    Largest largest;
    for (int i = 0; i < 1000; ++i) {
      const auto [u1, u2, v1, v2] = ends_for(angle);
      const auto expected = expected_cosines<Real>(u1, u2, v1, v2);
      const CosineArc published = arc_as_published(u1, u2, v1, v2);
      const double error = largest_error(published, expected);
      if (std::isfinite(error))
        largest.published = std::max(largest.published, error);
      else
        ++largest.not_numbers;
      largest.ours = std::max(largest.ours, largest_error(cosine_arc(u1, u2, v1, v2), expected));
    }
    record(fmt::format("{}_{:.0e}_published", name, angle), largest.published);
    record(fmt::format("{}_{:.0e}_published_nan_of_1000", name, angle), largest.not_numbers);
    record(fmt::format("{}_{:.0e}_ours", name, angle), largest.ours);
    return largest;
  };
  using Ends = std::array<glm::dvec3, 4>;
  const auto to_zero = [&](double angle) {
    const glm::dvec3 u1 = random.any(), v = random.any();
    return Ends{u1, random.at(u1, angle), v, v};
  };
  const auto to_pi = [&](double angle) {
    const glm::dvec3 u1 = random.any(), v = random.any();
    return Ends{u1, random.at(u1, angle, true), v, v};
  };
  const auto v_to_pi = [&](double angle) {
    const glm::dvec3 u1 = random.any(), v1 = random.any();
    return Ends{u1, random.at(u1, 1.0), v1, random.at(v1, angle, true)};
  };
  for (double angle : {1e-3, 1e-5, 1e-7, 1e-9, 1e-12}) {
    const Largest zero = measure("gamma_to_0", angle, to_zero), pi = measure("gamma_to_pi", angle, to_pi),
                  v = measure("gamma_v_to_pi", angle, v_to_pi);
    EXPECT_LT(zero.ours, 2e-15) << angle;
    EXPECT_LT(pi.ours, 2e-15) << angle;
    EXPECT_LT(v.ours, 1e-12) << angle;  // some come back opposed to u1
    if (angle > 1e-9) continue;
    EXPECT_GT(zero.not_numbers, 100) << angle;
    EXPECT_GT(pi.published, 0.1) << angle;
    EXPECT_GT(v.published, 0.1) << angle;
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
    ASSERT_EQ(arc.sweep, c_pi);
    ASSERT_NEAR(arc.at(0.0), glm::dot(u1, v), 1e-15);
    ASSERT_NEAR(arc.at(0.5), glm::dot(through, v), 2e-14);
    ASSERT_NEAR(arc.at(1.0), -glm::dot(u1, v), 1e-15);
    const glm::dvec3 half = slerp(u1, -u1, 0.5, middle);
    ASSERT_NEAR(glm::dot(half, through), 1.0, 1e-14);
    // v turns half round by way of the middle: about the axis across both.
    const glm::dvec3 axis = glm::cross(u1, through), w1 = random.any(), w2 = random.any();
    const CosineArc pair = cosine_arc(w1, w2, u1, -u1, {.v = middle});
    const CosineArc same = cosine_arc(w1, 2.0 * glm::dot(axis, w2) * axis - w2, u1);
    for (double t : {0.0, 0.3, 0.5, 1.0}) {
      ASSERT_NEAR(pair.at(t), same.at(t), 2e-14 / std::sin(pair.sweep)) << t;
    }
    // u2 is opposed to u1 once v's turn is undone; the middle of u is where it is, not where it is turned to.
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
    if (both.sweep == c_pi) {
      ASSERT_NEAR(both.at(0.5), glm::dot(um, vm), 1e-13);
      ++opposed;
    }
  }
  EXPECT_GT(opposed, 10'000);
}

TEST(Arc, OpposedEndsWithoutAMiddleTakeOneWayForAll) {
  Directions random(9);
  for (int i = 0; i < 100'000; ++i) {
    glm::dvec3 u1 = random.any();
    if (i < 6) u1 = glm::dvec3(0.0), u1[i / 2] = i % 2 ? -1.0 : 1.0;
    const glm::dvec3 v = random.any();
    // The middle may be missing, in line with the ends, or not a number.
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

TEST(Arc, AmplitudeZeroWhereTheVectorIsAcrossThePlane) {
  const glm::dvec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  for (const glm::dvec3& v : {z, -z}) {
    const CosineArc arc = cosine_arc(x, y, v);
    EXPECT_EQ(arc.amplitude, 0.0);
    EXPECT_EQ(arc.sweep, c_pi / 2);
    EXPECT_NO_FATAL_FAILURE(expect_sane(arc));
  }
  EXPECT_EQ(cosine_arc(x, x, z).amplitude, 0.0);
  Directions random(10);
  for (int i = 0; i < 100'000; ++i) {
    const glm::dvec3 u1 = random.any(), u2 = random.at(u1, 0.5 + std::abs(random.uniform()));
    const CosineArc arc = cosine_arc(u1, u2, glm::normalize(glm::cross(u1, u2)));
    ASSERT_NO_FATAL_FAILURE(expect_sane(arc));
    ASSERT_LT(arc.amplitude, 1e-15);
  }
}

// A^n, the factor of a highlight: no amplitude is above 1, where a great n would make it infinite, and small
// ones go to 0 without a detour.
TEST(Arc, PowersOfTheAmplitudeUnderflowToZero) {
  Directions random(11);
  int ones = 0, zeros = 0;
  for (int i = 0; i < 300'000; ++i) {
    const glm::dvec3 u1 = random.any(), u2 = random.at(u1, c_small[random.below(c_small.size())]);
    const glm::dvec3 v = i % 3 == 0 ? u1 : i % 3 == 1 ? slerp(u1, u2, 0.5) : random.any();
    const double amplitude = cosine_arc(u1, u2, v).amplitude;
    for (double n : {1.0, 50.0, 1e6, 1e300}) {
      const double power = std::pow(amplitude, n);
      ASSERT_TRUE(power >= 0.0 && power <= 1.0) << amplitude << " ^ " << n;
      ones += n == 1e300 && power == 1.0;
      zeros += n == 1e300 && power == 0.0;
    }
  }
  EXPECT_GT(ones, 1000);
  EXPECT_GT(zeros, 1000);
}

// H = (L + V)/|L + V| is 0/0 where light and eye are opposed: whatever stands for it, no highlight comes of
// it.
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
    // As a middle it is as good as none.
    EXPECT_EQ(slerp(n1, -n1, 0.5, none), slerp(n1, -n1, 0.5));
    EXPECT_EQ(cosine_arc(n1, -n1, n2, {none, none}).amplitude, cosine_arc(n1, -n1, n2).amplitude);
  }
}

// Both ends are one pixel: any t gives the cosine there.
TEST(Arc, OnePixelSpans) {
  Directions random(12);
  for (int i = 0; i < 100'000; ++i) {
    const glm::dvec3 u = random.any(), v = i % 10 ? random.any() : i % 20 ? u : -u;
    for (const CosineArc& arc : {cosine_arc(u, u, v), cosine_arc(u, u, v, v)}) {
      ASSERT_NO_FATAL_FAILURE(expect_sane(arc));
      ASSERT_EQ(arc.sweep, 0.0);
      for (double t : {0.0, 0.5, 1.0}) ASSERT_NEAR(arc.at(t), glm::dot(u, v), 5e-16);
    }
    ASSERT_EQ(slerp(u, u, 0.7), u);
  }
}

// Whether a light is above the horizon is read off the angle itself: within +-pi/2 or not, no whole turns.
TEST(Arc, HighlightBehindTheLightsHorizon) {
  Directions random(13);
  int behind = 0, turned = 0;
  for (int i = 0; i < 200'000; ++i) {
    const glm::dvec3 n1 = random.any(), n2 = i % 4 ? random.any() : random.at(n1, 1e-3, true);
    const glm::dvec3 l1 = random.any(), l2 = i % 3 ? l1 : random.any();
    const CosineArc arc = cosine_arc(n1, n2, l1, l2);
    ASSERT_NO_FATAL_FAILURE(expect_sane(arc));
    turned += std::abs(arc.phase) > c_pi;
    for (double t : {0.0, 0.125, 0.5, 0.625, 1.0}) {
      const double angle = t * arc.sweep - arc.phase, cosine = arc.at(t);
      ASSERT_LE(std::abs(angle), 1.5 * c_pi + 1e-15);
      if (std::abs(cosine) < 1e-14) continue;
      ASSERT_EQ(std::abs(angle) < c_pi / 2, cosine > 0.0) << angle << ' ' << cosine;
      behind += cosine < 0.0;
      if (t == 0.0 || t == 1.0) {
        ASSERT_EQ(cosine > 0.0, (t == 0.0 ? glm::dot(n1, l1) : glm::dot(n2, l2)) > 0.0);
      }
    }
  }
  EXPECT_GT(behind, 100'000);
  EXPECT_GT(turned, 1'000);
}

TEST(Arc, TurnedRoundItIsTheSame) {
  Directions random(15);
  for (int i = 0; i < 100'000; ++i) {
    const glm::dvec3 u1 = random.any(), u2 = random.any(), v1 = random.any(), v2 = random.any();
    const CosineArc there = cosine_arc(u1, u2, v1, v2), back = cosine_arc(u2, u1, v2, v1);
    ASSERT_NEAR(there.sweep, back.sweep, 2e-14);
    for (double t : {0.0, 0.2, 0.5, 1.0}) {
      ASSERT_NEAR(there.at(t), back.at(1.0 - t), 2.0 * c_bound / std::sin(there.sweep));
    }
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

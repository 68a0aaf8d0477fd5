// SPDX-License-Identifier: Apache-2.0
// For tests: turning directions, in MPFR's numbers or long double, computed without angles.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <random>

#include "common/test/big_real.hpp"

namespace halfway {

// The same directions computed without an angle: the direction half way between two unit vectors is their
// normalized sum, and the rotation from one to another is two half turns.

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

/// The great circle from a to b at t = 0, 1/8, 2/8 ... 1. a and b must not be opposite.
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

/// Undoes the rotation v1 -> v2. That rotation is a half turn about v1, then a half turn about the middle
/// between v1 and v2: it moves v1 to v2 and keeps v1 x v2.
template <class R>
Vector<R> turned_back(const Vector<R>& x, const Vector<R>& v1, const Vector<R>& v2) {
  const Vector<R> a = unit(v1), middle = unit(a + unit(v2));
  return half_turn(half_turn(x, middle), a);
}

/// Cosines at the eighths, with v fixed at v1.
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
  /// A direction at an angle from u, correct in the last bit of its components: pi - 1e-12 differs from pi.
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

}  // namespace halfway

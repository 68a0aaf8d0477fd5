// SPDX-License-Identifier: Apache-2.0
// Exact signs of sums of products.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace halfway {

/// The exact sum of products of doubles. The parts are in increasing order and their bits do not overlap, so
/// the last part has the sign of the sum. A product below 2^-968 is rounded. Source: J. R. Shewchuk, Adaptive
/// Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates, 1997, GROW-EXPANSION.
class ExactSum {
 public:
  void add(double term) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      // The exact sum of two doubles: the nearest double and the rest.
      const double sum = term + parts_[i];
      const double added = sum - term;
      const double rest = (term - (sum - added)) + (parts_[i] - added);
      if (rest != 0.0) parts_[kept++] = rest;
      term = sum;
    }
    if (term != 0.0) parts_[kept++] = term;
    size_ = kept;
  }
  void add_product(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
  int sign() const { return size_ == 0 ? 0 : parts_[size_ - 1] > 0.0 ? 1 : -1; }
  /// The sum to about one unit in the last place.
  double value() const { return size_ == 0 ? 0.0 : parts_[size_ - 1]; }

 private:
  /// Terms are multiples of 2^-1074, and below 2^256 for coordinates in the range of float. The parts of 2^26
  /// products take at most 1356 bits, and no two parts are adjacent.
  static constexpr std::size_t c_most_parts = 1356 / 2 + 1;
  std::array<double, c_most_parts> parts_;
  std::size_t size_ = 0;
};

/// A point whose coordinates are in the range of float.
struct PlanePoint {
  double x = 0.0, y = 0.0;
  bool operator==(const PlanePoint&) const = default;
};

/// 1 if a, b, c are in counter-clockwise order, -1 if clockwise, 0 if they are on one line. Exact.
inline int orientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  // In double the error of the determinant is below 4 units of 2^-53.
  constexpr double c_error = 0x1p-51;
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double bound = c_error * (std::abs(left) + std::abs(right));
  if (left - right > bound) return 1;
  if (right - left > bound) return -1;
  // The terms that cancel are left out.
  ExactSum sum;
  sum.add_product(a.x, b.y);
  sum.add_product(-a.y, b.x);
  sum.add_product(a.y, c.x);
  sum.add_product(-a.x, c.y);
  sum.add_product(b.x, c.y);
  sum.add_product(-b.y, c.x);
  return sum.sign();
}

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// The quadratic through a triangle's three vertices and three edge midpoints: with one division, and as
// printed, with five. The number type is a parameter, so that the operations of both can be counted.
#pragma once

#include <array>

namespace halfway::figures {

/// I(X, Y) = t5 X² + t4 XY + t3 Y² + t2 X + t1 Y + t0, relative to the first vertex (quadratic paper,
/// equation 4).
template <class Value>
struct QuadraticCoefficients {
  Value t5, t4, t3, t2, t1, t0;

  template <class Scalar>
  Value at(Scalar x, Scalar y) const {
    return (t5 * x + t4 * y + t2) * x + (t3 * y + t1) * y + t0;
  }
};

/// Values at vertices 1, 2, 3 and at the midpoints of edges 12, 13, 23. Vertices 2 and 3 are relative to
/// vertex 1.
template <class Scalar, class Value>
QuadraticCoefficients<Value> fit_six_points(Scalar x2, Scalar y2, Scalar x3, Scalar y3,
                                            const std::array<Value, 6>& values) {
  const auto& [i1, i2, i3, i12, i13, i23] = values;
  const Scalar inverse = 1.0 / (x2 * y3 - y2 * x3), squared = inverse * inverse;
  const Value twice_12 = 2.0 * i12, twice_13 = 2.0 * i13;
  const Value q2 = 2.0 * (i1 + i2 - twice_12), q3 = 2.0 * (i1 + i3 - twice_13);
  const Value c2 = i2 - i1 - q2, c3 = i3 - i1 - q3;  // 4 I12 - 3 I1 - I2; the same for 13
  const Value b = 4.0 * (i23 + i1 - i12 - i13);
  const Value q2_y3 = q2 * y3, q2_x3 = q2 * x3, q3_y2 = q3 * y2, q3_x2 = q3 * x2, b_y2 = b * y2,
              b_x2 = b * x2;
  return {(q2_y3 * y3 - b_y2 * y3 + q3_y2 * y2) * squared,
          (b_x2 * y3 + b_y2 * x3 - 2.0 * (q2_x3 * y3 + q3_x2 * y2)) * squared,
          (q2_x3 * x3 - b_x2 * x3 + q3_x2 * x2) * squared,
          (c2 * y3 - c3 * y2) * inverse,
          (c3 * x2 - c2 * x3) * inverse,
          i1};
}

/// The same by the formulas of section 3 of the quadratic paper. Each value is computed once. It divides by
/// zero if y2 = 0.
template <class Scalar>
QuadraticCoefficients<Scalar> fit_six_points_as_printed(Scalar x2, Scalar y2, Scalar x3, Scalar y3,
                                                        const std::array<Scalar, 6>& values) {
  const auto& [i1, i2, i3, i12, i13, i23] = values;
  const Scalar c2 = 4.0 * i12 - 3.0 * i1 - i2, c12 = i1 + i2 - 2.0 * i12;
  const Scalar c3 = 4.0 * i13 - 3.0 * i1 - i3, c13 = i1 + i3 - 2.0 * i13;
  const Scalar c23 = 4.0 * i1 - 4.0 * i12 - 4.0 * i13 + 4.0 * i23;
  const Scalar area = x2 * y3 - y2 * x3;
  const Scalar a = 2.0 * x2 * x2 * y3 - 2.0 * x2 * y2 * x3, b = y2 * x3 * y3 - x2 * y3 * y3;
  const Scalar c = x2 * y2 * y3 - y2 * y2 * x3, d = 2.0 * y2 * x3 * x3 - 2.0 * x2 * x3 * y3;
  const Scalar e = 4.0 * c13 * y2 - c23 * y3, f = 4.0 * c12 * y3 - c23 * y2;
  const Scalar below = a * b - c * d;
  const Scalar t4 = (e * a - f * d) / below, t5 = (f * b - e * c) / below;
  const Scalar t3 = (2.0 * c12 - t5 * x2 * x2 - t4 * x2 * y2) / (y2 * y2);
  return {t5, t4, t3, (c2 * y3 - c3 * y2) / area, (c3 * x2 - c2 * x3) / area, i1};
}

struct OperationCounts {
  int additions = 0, multiplications = 0, divisions = 0;
};

/// A number that counts the operations on it.
class CountedNumber {
 public:
  CountedNumber(double value, OperationCounts& counts) : value_(value), counts_(&counts) {}
  double value() const { return value_; }

  friend CountedNumber operator+(CountedNumber a, CountedNumber b) {
    ++a.counts_->additions;
    return {a.value_ + b.value_, *a.counts_};
  }
  friend CountedNumber operator-(CountedNumber a, CountedNumber b) {
    ++a.counts_->additions;
    return {a.value_ - b.value_, *a.counts_};
  }
  friend CountedNumber operator*(CountedNumber a, CountedNumber b) {
    ++a.counts_->multiplications;
    return {a.value_ * b.value_, *a.counts_};
  }
  friend CountedNumber operator*(double a, CountedNumber b) { return CountedNumber(a, *b.counts_) * b; }
  friend CountedNumber operator/(CountedNumber a, CountedNumber b) {
    ++b.counts_->divisions;
    return {a.value_ / b.value_, *b.counts_};
  }
  friend CountedNumber operator/(double a, CountedNumber b) { return CountedNumber(a, *b.counts_) / b; }

 private:
  double value_;
  OperationCounts* counts_;
};

}  // namespace halfway::figures

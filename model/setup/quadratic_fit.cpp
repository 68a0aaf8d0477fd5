// SPDX-License-Identifier: Apache-2.0
#include "setup/quadratic_fit.hpp"

namespace halfway {
namespace {

Int128 twice_area(const std::array<ScreenPoint, 3>& p) {
  return Int128{p[1].x - p[0].x} * (p[2].y - p[0].y) - Int128{p[1].y - p[0].y} * (p[2].x - p[0].x);
}

// A divisor must be positive. The numerators change their sign with it.
Int128 magnitude(Int128 v) {
  return v < 0 ? -v : v;
}

// A pixel's centre relative to the first vertex.
std::int64_t centre(std::int64_t pixel, std::int32_t origin, int unit_bits) {
  const std::int64_t unit = std::int64_t{1} << unit_bits;
  return pixel * unit + unit / 2 - origin;
}

}  // namespace

QuadraticFit::QuadraticFit(std::array<ScreenPoint, 3> points, int unit_bits)
    : points_(points),
      unit_bits_(unit_bits),
      x2_(std::int64_t{points[1].x} - points[0].x),
      y2_(std::int64_t{points[1].y} - points[0].y),
      x3_(std::int64_t{points[2].x} - points[0].x),
      y3_(std::int64_t{points[2].y} - points[0].y),
      d_(twice_area(points)),
      divider_(d_ * d_) {}

QuadraticWords QuadraticFit::words(const SixSamples& i, const DifferenceStart& start,
                                   std::int64_t half) const {
  const Int128 c2 = 4 * Int128{i.edge12} - 3 * Int128{i.vertex[0]} - i.vertex[1];
  const Int128 c3 = 4 * Int128{i.edge13} - 3 * Int128{i.vertex[0]} - i.vertex[2];
  const Int128 q2 = 2 * (Int128{i.vertex[0]} + i.vertex[1] - 2 * Int128{i.edge12});
  const Int128 q3 = 2 * (Int128{i.vertex[0]} + i.vertex[2] - 2 * Int128{i.edge13});
  const Int128 b = 4 * (Int128{i.edge23} - i.edge12 - i.edge13 + i.vertex[0]);
  // Numerators: t1 and t2 with divisor D, t3 to t5 with divisor D^2.
  const Int128 t1 = c3 * x2_ - c2 * x3_;
  const Int128 t2 = c2 * y3_ - c3 * y2_;
  const Int128 t3 = (q2 * x3_ - b * x2_) * x3_ + q3 * x2_ * x2_;
  const Int128 t4 = -2 * q2 * x3_ * y3_ + b * (x2_ * y3_ + x3_ * y2_) - 2 * q3 * x2_ * y2_;
  const Int128 t5 = (q2 * y3_ - b * y2_) * y3_ + q3 * y2_ * y2_;

  const std::int64_t s = std::int64_t{1} << unit_bits_;  // one pixel
  const Int128 u = centre(start.x, points_[0].x, unit_bits_);
  const Int128 v = centre(start.y, points_[0].y, unit_bits_);
  const Int128 a = start.quotient * s;  // e0 = (a, s)
  const Int128 gradient_u = t2 * d_ + 2 * t5 * u + t4 * v;
  const Int128 gradient_v = t1 * d_ + t4 * u + 2 * t3 * v;

  // Six words are rounded. The others are sums of these, so that the integer differences stay consistent.
  const Int128 value = divider_.rounded(Int128{i.vertex[0]} * d_ * d_ + (t2 * u + t1 * v) * d_ + t5 * u * u +
                                        t4 * u * v + t3 * v * v);
  // Round the step in the direction of the span, so that its error does not depend on the opposite direction.
  const int sign = start.backward ? -1 : 1;
  const Int128 dx = divider_.rounded(sign * gradient_u * s + t5 * s * s);
  const Int128 step_e0 =
      divider_.rounded(gradient_u * a + gradient_v * s + t5 * a * a + t4 * a * s + t3 * s * s);
  const Int128 xx = divider_.rounded(2 * t5 * s * s);
  const Int128 xe0 = divider_.rounded((2 * t5 * a + t4 * s) * s);
  const Int128 e0e0 = divider_.rounded(2 * (t5 * a * a + t4 * a * s + t3 * s * s));

  const Int128 step_x = start.backward ? xx - dx : dx;

  QuadraticWords w;
  w.value = value + half;
  w.dx = dx;
  w.de0 = step_e0;
  w.de1 = step_e0 + step_x + xe0;
  w.dxx = xx;
  w.dxe0 = sign * xe0;
  w.dxe1 = sign * (xe0 + xx);
  w.de0e0 = e0e0;
  w.de0e1 = e0e0 + xe0;
  w.de1e1 = e0e0 + 2 * xe0 + xx;
  return w;
}

QuadraticWords PixelFit::words(std::span<const std::int64_t> colours, const DifferenceStart& start,
                               std::int64_t half) const {
  // Colour per pixel to the right. A single pixel or a diagonal pair has none.
  Int128 right = 0;
  for (std::size_t i = 1; i < pixels_.size(); ++i)
    if (pixels_[i].y == pixels_[i - 1].y) right = Int128{colours[i]} - colours[i - 1];
  // Colour per line down.
  Int128 down = 0;
  for (std::size_t i = 1; i < pixels_.size(); ++i)
    if (pixels_[i].y != pixels_[i - 1].y)
      down = Int128{colours[i]} - colours[i - 1] - right * (pixels_[i].x - pixels_[i - 1].x);

  QuadraticWords w{};
  w.value = colours[0] + right * (start.x - pixels_[0].x) + down * (start.y - pixels_[0].y) + half;
  w.dx = start.backward ? -right : right;
  w.de0 = right * start.quotient + down;
  w.de1 = w.de0 + right;
  return w;
}

DepthFit::DepthFit(std::array<ScreenPoint, 3> p, int unit_bits, std::array<std::int64_t, 3> z)
    : origin_(p[0]), unit_bits_(unit_bits), depth_(z[0]), d_(twice_area(p)), divider_(magnitude(d_)) {
  const Int128 x2 = Int128{p[1].x} - p[0].x, y2 = Int128{p[1].y} - p[0].y;
  const Int128 x3 = Int128{p[2].x} - p[0].x, y3 = Int128{p[2].y} - p[0].y;
  const int sign = d_ < 0 ? -1 : 1;
  zu_ = sign * ((z[1] - z[0]) * y3 - (z[2] - z[0]) * y2);
  zv_ = sign * ((z[2] - z[0]) * x2 - (z[1] - z[0]) * x3);
  d_ = magnitude(d_);
}

DepthWords DepthFit::words(const DifferenceStart& start, std::int64_t half) const {
  const std::int64_t s = std::int64_t{1} << unit_bits_;
  const std::int64_t u = centre(start.x, origin_.x, unit_bits_), v = centre(start.y, origin_.y, unit_bits_);
  DepthWords w;
  w.value = divider_.rounded(depth_ * d_ + zu_ * u + zv_ * v) + half;
  const Int128 step_x = divider_.rounded(zu_ * s);
  w.dx = start.backward ? -step_x : step_x;
  w.de0 = divider_.rounded(zu_ * start.quotient * s + zv_ * s);
  w.de1 = w.de0 + step_x;
  return w;
}

}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
#include "setup/quadratic_fit.hpp"

#include <algorithm>

namespace halfway {
namespace {

using Weights = QuadraticStart::Weights;

// Samples that have a weight: the other vertices, then the midpoints, each between two vertices.
constexpr std::array<std::size_t, 2> c_vertices = {1, 2};
constexpr std::array<std::pair<std::size_t, std::size_t>, 3> c_edge_ends = {{{0, 1}, {0, 2}, {1, 2}}};

// The symmetric bilinear form whose value for (l, l) is the quadratic part of the weights at l.
Weights products(const Barycentric& p, const Barycentric& q) {
  Weights w;
  auto weight = w.begin();
  for (const std::size_t i : c_vertices) *weight++ = 2 * (Int128{p[i]} * q[i]);
  for (const auto& [i, j] : c_edge_ends) *weight++ = 2 * (Int128{p[i]} * q[j] + Int128{p[j]} * q[i]);
  return w;
}
Weights doubled(Weights w) {
  for (Int128& weight : w) weight *= 2;
  return w;
}

// Weights at l.
Weights value_at(const Barycentric& l, std::int64_t d) {
  Weights w = products(l, l);
  for (std::size_t i = 0; i < c_vertices.size(); ++i) w[i] -= Int128{d} * l[c_vertices[i]];
  return w;
}
// Weights at l + step minus weights at l.
Weights first_difference(const Barycentric& l, const Barycentric& step, std::int64_t d) {
  Barycentric sum;
  for (std::size_t i = 0; i < 3; ++i) sum[i] = 2 * l[i] + step[i];
  Weights w = products(step, sum);
  for (std::size_t i = 0; i < c_vertices.size(); ++i) w[i] -= Int128{d} * step[c_vertices[i]];
  return w;
}
// The change of the first difference along p by a step q.
Weights second_difference(const Barycentric& p, const Barycentric& q) {
  return doubled(products(p, q));
}

Barycentric times(const Barycentric& step, std::int64_t factor) {
  return {factor * step[0], factor * step[1], factor * step[2]};
}
// Round the step in the direction of the span, so that its error does not depend on the opposite direction.
Barycentric along_span(const BarycentricStart& start) {
  return times(start.right, start.backward ? -1 : 1);
}

// True if all weights of the words at this start are below 2^62 in magnitude: the largest is a sum of at most
// 15 products of two coordinates.
bool has_narrow_weights(const BarycentricStart& start) {
  constexpr std::int64_t c_most = std::int64_t{1} << 29;
  const auto is_small = [&](const Barycentric& l) {
    return std::all_of(l.begin(), l.end(), [](std::int64_t x) { return std::abs(x) < c_most; });
  };
  return is_small(start.at) && is_small(start.right) && is_small(start.e0);
}

}  // namespace

TriangleCoordinates::TriangleCoordinates(const std::array<ScreenPoint, 3>& p, int unit_bits)
    : origin_(p[0]),
      unit_bits_(unit_bits),
      x2_(std::int64_t{p[1].x} - p[0].x),
      y2_(std::int64_t{p[1].y} - p[0].y),
      x3_(std::int64_t{p[2].x} - p[0].x),
      y3_(std::int64_t{p[2].y} - p[0].y) {}

Barycentric TriangleCoordinates::step(std::int64_t u, std::int64_t v) const {
  const std::int64_t second = u * y3_ - v * x3_, third = v * x2_ - u * y2_;
  return {-second - third, second, third};
}

BarycentricStart TriangleCoordinates::start(const DifferenceStart& start) const {
  const std::int64_t pixel = std::int64_t{1} << unit_bits_;
  BarycentricStart from;
  from.at = step(start.x * pixel + pixel / 2 - origin_.x, start.y * pixel + pixel / 2 - origin_.y);
  from.at[0] += twice_area();
  from.right = step(pixel, 0);
  from.e0 = step(start.quotient * pixel, pixel);
  from.backward = start.backward;
  return from;
}

QuadraticStart::QuadraticStart(const BarycentricStart& start, std::int64_t d)
    : value_(value_at(start.at, d)),
      x_(first_difference(start.at, along_span(start), d)),
      e0_(first_difference(start.at, start.e0, d)),
      xx_(second_difference(start.right, start.right)),
      xe0_(second_difference(start.right, start.e0)),
      e0e0_(second_difference(start.e0, start.e0)),
      narrow_(has_narrow_weights(start)),
      backward_(start.backward),
      divider_(Int128{d} * d) {}

QuadraticWords QuadraticStart::words(const SixSamples& samples, std::int64_t half) const {
  return narrow_ ? words_by<std::int64_t>(samples, half) : words_by<Int128>(samples, half);
}

template <class Integer>
QuadraticWords QuadraticStart::words_by(const SixSamples& s, std::int64_t half) const {
  const std::int64_t first = s.vertex[0];
  const std::array<std::int64_t, 5> off_first = {s.vertex[1] - first, s.vertex[2] - first, s.edge12 - first,
                                                 s.edge13 - first, s.edge23 - first};
  const auto word = [&](const Weights& weights) {
    Int128 sum = 0;
    for (std::size_t i = 0; i < weights.size(); ++i)
      sum += Int128{static_cast<Integer>(weights[i])} * off_first[i];
    return divider_.rounded(sum);
  };
  // Six words are rounded. The others are sums of these, so that the integer differences stay consistent.
  const Int128 dx = word(x_), de0 = word(e0_), xx = word(xx_), xe0 = word(xe0_), e0e0 = word(e0e0_);
  const Int128 step_x = backward_ ? xx - dx : dx;
  const int sign = backward_ ? -1 : 1;

  QuadraticWords w;
  w.value = first + word(value_) + half;
  w.dx = dx;
  w.de0 = de0;
  w.de1 = de0 + step_x + xe0;
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

DepthWords PlaneFit::words(const std::array<std::int64_t, 3>& z, const BarycentricStart& start,
                           std::int64_t half) const {
  // A divisor is positive: the numerators have the sign of D.
  const int sign = coordinates_.twice_area() < 0 ? -1 : 1;
  const std::int64_t z2 = sign * (z[1] - z[0]), z3 = sign * (z[2] - z[0]);
  const auto word = [&](const Barycentric& l) {
    return divider_.rounded(Int128{l[1]} * z2 + Int128{l[2]} * z3);
  };
  const Int128 step_x = word(start.right);
  DepthWords w;
  w.value = z[0] + word(start.at) + half;
  w.dx = start.backward ? -step_x : step_x;
  w.de0 = word(start.e0);
  w.de1 = w.de0 + step_x;
  return w;
}

}  // namespace halfway

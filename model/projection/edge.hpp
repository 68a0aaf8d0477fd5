// SPDX-License-Identifier: Apache-2.0
// One edge of a triangle in exact arithmetic: for each line, which pixel centres lie to its right. Reference
// renderers, setup and coverage tests all use it to determine the covered pixels.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "frame/frame_size.hpp"

namespace halfway {

/// Floor division, with remainder in [0, d), d > 0.
struct FlooredQuotient {
  std::int64_t quotient, remainder;
};
constexpr FlooredQuotient floor_divide(std::int64_t n, std::int64_t d) {
  std::int64_t q = n / d, r = n % d;
  if (r < 0) --q, r += d;
  return {q, r};
}
constexpr std::int64_t ceil_divide(std::int64_t n, std::int64_t d) {
  return -floor_divide(-n, d).quotient;
}

/// A point on the screen in 1/2^unit_bits of a pixel. unit_bits is passed separately: 4, and one more per
/// level of subdivision, so that midpoints stay exact.
struct ScreenPoint {
  std::int32_t x, y;
  friend bool operator==(const ScreenPoint&, const ScreenPoint&) = default;
};

/// First line whose pixel centres are at or below y. Top rule: a centre on the edge belongs to the triangle
/// below.
constexpr std::int64_t first_line(std::int32_t y, int unit_bits) {
  const std::int64_t unit = std::int64_t{1} << unit_bits;
  return (2 * std::int64_t{y} + unit - 1) >> (unit_bits + 1);  // rounded up
}

/// An edge stepped from top to bottom. For a line y it gives the first pixel whose centre is at or right of
/// the edge (left rule).
class Edge {
 public:
  /// top.y < bottom.y
  constexpr Edge(ScreenPoint top, ScreenPoint bottom, int unit_bits)
      : unit_bits_(unit_bits),
        dx_(std::int64_t{bottom.x} - top.x),
        dy_(std::int64_t{bottom.y} - top.y),
        top_(top) {}

  /// State on line y: pixel p = ceil(N/D) with D = dy*2^unit_bits, and error = floor((pD - N)/2^unit_bits) in
  /// [0, dy). For the next line, add floor(dx/dy) to p and subtract (dx mod dy) from the error. A borrow adds
  /// one pixel.
  struct State {
    std::int64_t pixel, error;
  };
  constexpr State at(std::int64_t y) const {
    const std::int64_t unit = std::int64_t{1} << unit_bits_;
    // x of the edge at the line's centre minus half a pixel, times dy; doubled to keep all terms integers.
    const std::int64_t centre2 = (2 * y + 1) * unit;
    const std::int64_t n2 =
        (2 * std::int64_t{top_.x} - unit) * dy_ + dx_ * (centre2 - 2 * std::int64_t{top_.y});
    const std::int64_t pixel = ceil_divide(n2, 2 * dy_ * unit);
    return {pixel, (pixel * 2 * dy_ * unit - n2) >> (unit_bits_ + 1)};
  }
  constexpr std::int64_t pixel(std::int64_t y) const { return at(y).pixel; }
  constexpr std::int64_t dx() const { return dx_; }
  constexpr std::int64_t dy() const { return dy_; }

 private:
  int unit_bits_;
  std::int64_t dx_, dy_;
  ScreenPoint top_;
};

/// Calls span(y, x_begin, x_end) for each line of the frame on which the triangle covers at least one pixel.
/// The points may be in either orientation.
template <class Span>
void for_each_span(std::array<ScreenPoint, 3> p, int unit_bits, FrameSize frame, Span&& span) {
  if (p[1].y < p[0].y) std::swap(p[0], p[1]);
  if (p[2].y < p[0].y) std::swap(p[0], p[2]);
  if (p[2].y < p[1].y) std::swap(p[1], p[2]);
  const auto clamp_to = [](std::int64_t v, std::uint32_t limit) {
    return v < 0 ? std::int64_t{0} : v > limit ? std::int64_t{limit} : v;
  };
  const std::int64_t begin = clamp_to(first_line(p[0].y, unit_bits), frame.height);
  const std::int64_t middle = first_line(p[1].y, unit_bits);
  const std::int64_t end = clamp_to(first_line(p[2].y, unit_bits), frame.height);
  if (begin >= end) return;
  const Edge edge_long(p[0], p[2], unit_bits);
  const Edge upper = p[0].y < p[1].y ? Edge(p[0], p[1], unit_bits) : edge_long;
  const Edge lower = p[1].y < p[2].y ? Edge(p[1], p[2], unit_bits) : edge_long;
  for (std::int64_t y = begin; y < end; ++y) {
    std::int64_t a = clamp_to(edge_long.pixel(y), frame.width);
    std::int64_t b = clamp_to((y < middle ? upper : lower).pixel(y), frame.width);
    if (b < a) std::swap(a, b);
    if (a < b)
      span(static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
  }
}

/// A pixel of the frame.
struct Pixel {
  std::int64_t x, y;
  friend bool operator==(const Pixel&, const Pixel&) = default;
};

/// The pixels of the frame that the triangle covers, line by line, each line from left to right. A triangle
/// of at most 2 pixels in width and height covers at most three, of a block of 2x2: by the fill rule a pixel
/// is covered if the point a little to the right of its centre, and far less below it, is inside. Four such
/// points of a block would be a unit square inside a triangle of area 2 or less. The largest square in a
/// triangle has half its area and touches its edges.
inline std::vector<Pixel> covered_pixels(const std::array<ScreenPoint, 3>& p, int unit_bits,
                                         FrameSize frame) {
  std::vector<Pixel> pixels;
  for_each_span(p, unit_bits, frame, [&](std::uint32_t y, std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t x = begin; x < end; ++x) pixels.push_back({x, y});
  });
  return pixels;
}

}  // namespace halfway

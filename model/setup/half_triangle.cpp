// SPDX-License-Identifier: Apache-2.0
#include "setup/half_triangle.hpp"

#include <algorithm>

#include "common/to_integer.hpp"

namespace halfway {
namespace {

using words::Published;

// Words of an edge, modulo their width. One half is added to x: truncation then gives the nearest pixel.
struct EdgeWords {
  EdgeWords(long double x_real, long double slope_real)
      : x(wrapped_word(x_real + 0.5L, Published::c_edge_x_fraction_bits, Published::c_edge_x_bits)),
        slope(wrapped_word(slope_real, Published::c_edge_x_fraction_bits, Published::c_edge_x_bits)) {}
  // The pixel after that many steps.
  std::int64_t pixel(std::int64_t steps) const {
    const auto sum = words::Word<Published::c_edge_x_bits>::from_bits(static_cast<std::uint64_t>(x) +
                                                                      static_cast<std::uint64_t>(slope) *
                                                                          static_cast<std::uint64_t>(steps));
    return words::Word<Published::c_span_x_bits>::from_bits(
               static_cast<std::uint64_t>(sum.value() >> Published::c_edge_x_fraction_bits))
        .value();
  }

  std::int64_t x, slope;
};

}  // namespace

HalfVertex half_vertex(ScreenPoint corner, int level, double depth_steps) {
  const auto nearest_pixel = [level](std::int32_t v) {
    return static_cast<long double>(
        floor_divide(2 * std::int64_t{v} + (std::int64_t{1} << level), std::int64_t{2} << level).quotient);
  };
  return {nearest_pixel(corner.x), nearest_pixel(corner.y), depth_steps};
}

long double twice_area(const std::array<HalfVertex, 3>& p) {
  return (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
}

std::vector<HalfTriangle> half_triangles(const std::array<HalfVertex, 3>& p) {
  std::vector<HalfTriangle> halves;
  if (twice_area(p) == 0) return halves;
  std::array<std::size_t, 3> order = {0, 1, 2};
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a].y < p[b].y; });
  const std::size_t top = order[0], mid = order[1], bottom = order[2];
  // Compare products of integers: a rounded edge could be on the wrong side of a vertex that it meets.
  const bool long_left =
      (p[bottom].x - p[top].x) * (p[mid].y - p[top].y) < (p[mid].x - p[top].x) * (p[bottom].y - p[top].y);
  const long double along = (p[bottom].x - p[top].x) / (p[bottom].y - p[top].y);
  const auto add = [&](std::size_t from, std::size_t to) {
    if (p[from].y == p[to].y) return;
    // The long edge is part of both halves.
    const long double x_long = p[top].x + (p[from].y - p[top].y) * along;
    const long double slope_short = (p[to].x - p[from].x) / (p[to].y - p[from].y);
    HalfTriangle half{to_integer<std::int64_t>(p[from].y),
                      to_integer<std::int64_t>(p[to].y - p[from].y) + 1,
                      {top, bottom},
                      {from, to},
                      x_long,
                      along,
                      p[from].x,
                      slope_short};
    if (!long_left) {
      std::swap(half.start, half.stop);
      std::swap(half.x_start, half.x_stop);
      std::swap(half.slope_start, half.slope_stop);
    }
    halves.push_back(half);
  };
  add(top, mid);
  add(mid, bottom);
  return halves;
}

HalfLine line_of(const HalfTriangle& half, std::int64_t y) {
  const std::int64_t steps = y - half.y;
  return {EdgeWords(half.x_start, half.slope_start).pixel(steps),
          EdgeWords(half.x_stop, half.slope_stop).pixel(steps)};
}

void put_header(InitVector& init, std::uint32_t triangle, const HalfTriangle& h,
                const std::array<HalfVertex, 3>& p) {
  using At = Published::init_header_at;
  constexpr int c_z_fraction = Published::c_depth_sum_fraction_bits, c_z_bits = Published::c_depth_sum_bits;
  init.put(At::triangle, triangle);
  init.put(At::y, h.y);
  init.put(At::upper_lines, h.lines);
  const EdgeWords start(h.x_start, h.slope_start), stop(h.x_stop, h.slope_stop);
  init.put(At::start_x, start.x);
  init.put(At::start_slope, start.slope);
  init.put(At::upper_x, stop.x);
  init.put(At::upper_slope, stop.slope);
  const long double x2 = p[1].x - p[0].x, y2 = p[1].y - p[0].y, x3 = p[2].x - p[0].x, y3 = p[2].y - p[0].y;
  const long double d = x2 * y3 - y2 * x3;
  const long double zu = ((p[1].z - p[0].z) * y3 - (p[2].z - p[0].z) * y2) / d;
  const long double zv = ((p[2].z - p[0].z) * x2 - (p[1].z - p[0].z) * x3) / d;
  const long double u = h.x_start - p[0].x, v = static_cast<long double>(h.y) - p[0].y;
  init.put(At::z, wrapped_word(p[0].z + zu * u + zv * v + 0.5L, c_z_fraction, c_z_bits));
  init.put(At::z_dx, wrapped_word(zu, c_z_fraction, c_z_bits));
  init.put(At::z_de0, wrapped_word(zu * h.slope_start + zv, c_z_fraction, c_z_bits));
}

}  // namespace halfway

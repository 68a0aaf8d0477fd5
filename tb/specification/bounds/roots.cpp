// SPDX-License-Identifier: Apache-2.0
// 1/sqrt(x) for every x, and the unit vectors that are computed with it.
#include <fmt/format.h>

#include <numbers>
#include <random>

#include "golden/half_vector.hpp"
#include "golden/unit_vector.hpp"
#include "registry.hpp"

namespace halfway::bounds {
namespace {

using golden::Axes, words::Exact, words::Published, golden::ReciprocalRoot;

// The table only: each entry over its whole cell. x^-1/2 decreases, so the error is largest at an end of it.
template <class P>
Finding entry(const Context&, const Stated& stated) {
  const words::FunctionTable& table = golden::function_table<P>(words::Function::reciprocal_root);
  const int cells = 1 << table.cell_bits;
  Finding finding;
  for (int i = 0; i < cells; ++i) {
    const double value = std::ldexp(table.values[static_cast<std::size_t>(i)], -table.fraction_bits);
    for (const int end : {i, i + 1}) {
      const double x = end < cells / 2 ? 1 + 2.0 * end / cells : 4.0 * end / cells;
      // Relative to the root: |value sqrt(x) - 1|.
      const double error =
          stated.bound.of == "relative" ? distance(1, value * sqrt(x)) : distance(value, 1.0 / sqrt(x));
      keep_worst(finding, error, [&] { return fmt::format("entry {} at x = {}", i, x); });
    }
  }
  finding.proved = finding.worst;
  return finding;
}

// y sqrt(x) - 1 without cancellation: (y^2 x - 1) / (y sqrt(x) + 1), where y^2 x is a whole number.
template <class P>
double relative_error(std::uint32_t x) {
  constexpr int c_root = P::c_root_fraction_bits, c_square = P::c_square_fraction_bits;
  const auto y = static_cast<unsigned __int128>(ReciprocalRoot<P>::root(x));
  const auto off = static_cast<__int128>(y * y * x) - (static_cast<__int128>(1) << (2 * c_root + c_square));
  const double away = std::ldexp(static_cast<double>(off), -2 * c_root - c_square);
  return away / (std::sqrt(1.0 + away) + 1.0);
}

template <class P>
Finding root(const Context& context, const Stated&) {
  constexpr std::uint32_t c_one = std::uint32_t{1} << P::c_square_fraction_bits;
  constexpr bool c_newton = P::c_root_fraction_bits > P::c_root_entry_fraction_bits;
  // The Newton step cuts x to 22 fraction bits. Its error is largest at an end of each range of equal cut
  // values.
  constexpr std::uint32_t c_stretch = c_newton ? 1U << (P::c_square_fraction_bits - 22) : 1;
  const std::uint32_t stride = c_newton && context.quick ? 41 * c_stretch : c_stretch;
  Finding finding;
  const auto see = [&](std::uint32_t x) {
    const double error = std::fabs(relative_error<P>(x)) + 0x1p-50;
    keep_worst(finding, error, [&] {
      return fmt::format("x = {:.9f}, word {}", std::ldexp(x, -P::c_square_fraction_bits), x);
    });
  };
  for (std::uint64_t x = c_one; x < std::uint64_t{4} * c_one; x += stride) {
    see(static_cast<std::uint32_t>(x));
    if (c_newton) see(static_cast<std::uint32_t>(x) + c_stretch - 1);
  }
  if (stride == c_stretch) finding.proved = finding.worst;
  return finding;
}

// The square is the upper bits of the exact one.
template <class P>
Finding square(const Context&, const Stated& stated) {
  constexpr int c_bits = P::c_direction_bits, c_drop = 2 * (c_bits - 1) - P::c_square_fraction_bits;
  std::mt19937_64 random(4);
  Finding finding;
  for (int i = 0; i < 100'000; ++i) {
    Axes u;
    for (std::int64_t& c : u) c = static_cast<std::int64_t>(random()) >> (64 - c_bits);
    const std::int64_t exact = golden::dot_product(u, u);
    const double error =
        std::ldexp(static_cast<double>(exact - (exact >> c_drop << c_drop)), -2 * (c_bits - 1));
    keep_worst(finding, error, [&] { return fmt::format("({}, {}, {}) in units", u[0], u[1], u[2]); });
  }
  finding.proved = stated.format.unit() * (1 - std::ldexp(1.0, -c_drop));
  return finding;
}

struct Unit {
  double length = 0, angle = 0;
};
template <class P, int VectorBits>
Unit errors_of(const Axes& v) {
  const Axes w = golden::normalized<P, VectorBits>(v);
  long double x[3], u[3], square = 0, unit_square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = static_cast<long double>(v[i]);
    u[i] = std::ldexp(static_cast<long double>(w[i]), -P::c_direction_fraction_bits);
    square += x[i] * x[i];
    unit_square += u[i] * u[i];
  }
  const long double a = u[1] * x[2] - u[2] * x[1], b = u[2] * x[0] - u[0] * x[2],
                    c = u[0] * x[1] - u[1] * x[0];
  const long double length = std::sqrt(unit_square);
  return {static_cast<double>(std::fabs(length - 1)),
          static_cast<double>(std::asin(std::sqrt(a * a + b * b + c * c) / std::sqrt(square) / length))};
}

// Hill climbing from random vectors: changes one component or all by a few units.
template <class P, int VectorBits>
void climb(bool of_length, int starts, Finding& finding) {
  std::mt19937_64 random(VectorBits + (of_length ? 100 : 0));
  const auto value = [&](const Axes& v) {
    const Unit e = errors_of<P, VectorBits>(v);
    return of_length ? e.length : e.angle;
  };
  constexpr std::int64_t c_largest = (std::int64_t{1} << (VectorBits - 1)) - 1;
  for (int i = 0; i < starts; ++i) {
    Axes v;
    for (std::int64_t& c : v)
      c = (static_cast<std::int64_t>(random()) >> (64 - VectorBits)) >> random() % (VectorBits - 1);
    // The worst vectors are often close to an axis, with a component just above 1/2.
    if (i % 2 == 0)
      v[random() % 3] = (c_largest >> random() % 3 >> 1) + static_cast<std::int64_t>(random() % 4096);
    if (v == Axes{}) continue;
    double best = value(v);
    for (int step = 0; step < 60; ++step) {
      Axes next = v;
      for (std::int64_t& c : next)
        if (random() % 2 == 0)
          c = std::clamp(
              c + ((static_cast<std::int64_t>(random()) >> (64 - VectorBits)) >> random() % VectorBits),
              -c_largest - 1, c_largest);
      if (next == Axes{}) continue;
      if (const double e = value(next); e > best) best = e, v = next;
    }
    keep_worst(finding, best,
               [&] { return fmt::format("({}, {}, {}) of {} bits", v[0], v[1], v[2], VectorBits); });
  }
}

template <class P>
Finding length(const Context& context, const Stated& stated) {
  Finding finding;
  const int starts = context.quick ? 3'000 : 200'000;
  climb<P, P::c_vector_bits>(true, starts, finding);
  climb<P, P::c_offset_bits>(true, starts, finding);
  climb<P, golden::c_half_sum_bits<P>>(true, starts / 10, finding);
  // The derivation, with the error of the root over every x.
  const double all_roots = root<P>(context, stated).proved;
  if (all_roots > 0)
    finding.proved = all_roots + 2 * std::ldexp(1.0, -P::c_square_fraction_bits) +
                     std::sqrt(3.0) * stated.format.unit() / 2;
  return finding;
}

// The largest angle between v and its unit vector, from the two roundings only. v is scaled so that its
// largest component is at least 1/2, cut by e in [0, cut)^3, then rounded by r in [-half, half]^3. Bounded on
// boxes of directions (1, p, q) by intervals, for every corner of cut and rounding.
double angle_bound(double cut, double half) {
  constexpr int c_cells = 1000;
  double most = 0;
  const auto corner = [](int i, int axis) { return i >> axis & 1 ? 1.0 : 0.0; };
  for (int i = -c_cells; i < c_cells; ++i)
    for (int j = i < 0 ? -c_cells : 0; j < c_cells; ++j) {
      const double p = (i + 0.5) / c_cells, q = (j + 0.5) / c_cells;
      // Bound of the angle between the box's centre and its points.
      const double slack = std::numbers::sqrt2 / 2 / c_cells;
      const double square = 1 + p * p + q * q, size = std::sqrt(square);
      const auto across = [&](double a, double b, double c) {
        const double along = (a + b * p + c * q) / size;
        return std::sqrt(std::max(0.0, a * a + b * b + c * c - along * along)) +
               slack * std::sqrt(a * a + b * b + c * c);
      };
      double by_cut = 0, by_rounding = 0;
      for (int k = 0; k < 8; ++k) {
        const double a = corner(k, 0), b = corner(k, 1), c = corner(k, 2);
        by_cut = std::max(by_cut, across(a, b, c));
        by_rounding = std::max(by_rounding, across(2 * a - 1, 2 * b - 1, 2 * c - 1));
      }
      // The shortest vector in the box's directions with a largest component of 1/2.
      const double shortest = 0.5 * (size - slack);
      most = std::max(most, cut * by_cut / shortest + half * by_rounding);
    }
  return most;
}

template <class P>
Finding direction_angle(const Context& context, const Stated& stated) {
  Finding finding;
  const int starts = context.quick ? 3'000 : 200'000;
  climb<P, P::c_vector_bits>(false, starts, finding);
  climb<P, P::c_offset_bits>(false, starts, finding);
  climb<P, golden::c_half_sum_bits<P>>(false, starts / 10, finding);
  // Use the longest vectors: their lowest bits are cut.
  constexpr int c_cut = std::max(0, P::c_offset_bits - P::c_direction_bits);
  const double unit = stated.format.unit() / 2;  // unit of a shifted vector
  const double shrunk = std::is_same_v<P, Exact> ? 1.42e-6 : 0.0094;
  const double across =
      angle_bound(unit * (1 - std::ldexp(1.0, -c_cut)), stated.format.unit() / 2 / (1 - shrunk));
  finding.proved = std::asin(across);
  return finding;
}

// The rounding of a cosine to a direction's fraction, for the processors' dot products; and the rounding of a
// component of a vector.
template <class P>
Finding component(const Context&, const Stated& stated) {
  constexpr int c_fraction = P::c_direction_fraction_bits;
  const std::int64_t most = std::int64_t{1} << c_fraction;
  Finding finding;
  for (std::int64_t low = 0; low < std::min<std::int64_t>(most, 1 << 20); low += c_fraction > 20 ? 1021 : 1) {
    const std::int64_t dot = most * (most / 3) + low * (most >> std::min(20, c_fraction));
    const double error =
        std::fabs(static_cast<double>((std::int64_t{golden::cosine<P>(dot)} << c_fraction) - dot)) *
        stated.format.unit() * stated.format.unit();
    keep_worst(finding, error, [&] { return fmt::format("a dot product of {}", dot); });
  }
  finding.proved = stated.format.unit() / 2;
  return finding;
}

// The offset from the surface to a light: place times 1/w, rounded, minus the shifted place, as in
// shading_processor.
Finding offset(const Context&, const Stated& stated) {
  using P = Exact;
  constexpr int c_drop =
      P::c_light_place_fraction_bits + P::c_vector_fraction_bits - P::c_offset_fraction_bits;
  std::mt19937_64 random(6);
  Finding finding;
  for (int i = 0; i < 2'000'000; ++i) {
    const auto word = [&](int bits) { return static_cast<std::int64_t>(random()) >> (64 - bits); };
    const std::int64_t place = word(P::c_light_place_bits), point = word(P::c_vector_bits),
                       distance = word(P::c_vector_bits) & ((std::int64_t{1} << (P::c_vector_bits - 1)) - 1);
    const auto shift = static_cast<int>(random() % 32);
    const std::int64_t made = golden::round_half_up(place * distance, c_drop) - (point >> shift);
    const long double truth =
        std::ldexp(static_cast<long double>(place) * static_cast<long double>(distance), -c_drop) -
        std::ldexp(static_cast<long double>(point), -shift);
    const auto error =
        static_cast<double>(std::fabs(static_cast<long double>(made) - truth)) * stated.format.unit();
    keep_worst(finding, error, [&] {
      return fmt::format("place {}, 1/w {}, point {}, shift {}", place, distance, point, shift);
    });
  }
  finding.proved = 1.5 * stated.format.unit();
  return finding;
}

}  // namespace

std::vector<Check> root_checks() {
  return {
      {"both", "root_entry", "", "whole cells, by 400 bits", of_preset(entry<Exact>, entry<Published>)},
      {"both", "root_entry", "relative", "whole cells, by 400 bits",
       of_preset(entry<Exact>, entry<Published>)},
      {"both", "root", "", "every x, in integers", of_preset(root<Exact>, root<Published>)},
      {"both", "square", "", "random vectors; a cut leaves less than a unit",
       of_preset(square<Exact>, square<Published>)},
      {"both", "direction", "component", "cosines of dot products; a rounding leaves half a unit",
       of_preset(component<Exact>, component<Published>)},
      {"both", "direction", "length", "every root, and a derivation; hill climbing",
       of_preset(length<Exact>, length<Published>)},
      {"both", "direction", "angle", "boxes of directions; hill climbing",
       of_preset(direction_angle<Exact>, direction_angle<Published>)},
      {"exact", "offset", "", "random places; a rounding and a cut", offset},
  };
}

}  // namespace halfway::bounds

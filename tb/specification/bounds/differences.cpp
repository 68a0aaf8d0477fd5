// SPDX-License-Identifier: Apache-2.0
// Forward differences in two dimensions at the largest frame. Gappa proves the stated errors for every start
// word. Triangles of the real setup, walked by the golden interpolators, come close to them.
#include <fmt/format.h>

#include <array>
#include <random>

#include "golden/quadratic_interpolator.hpp"
#include "golden/triangle_walker.hpp"
#include "golden/z_interpolator.hpp"
#include "registry.hpp"
#include "setup/walk_header.hpp"

namespace halfway::bounds {
namespace {

using words::Exact, words::Published;

constexpr std::int32_t c_side = 4096, c_unit_bits = 4, c_unit = 1 << c_unit_bits;

// The exact quadratic or plane at a pixel's centre, in units: numerators over d^2.
struct Truth {
  std::array<ScreenPoint, 3> points;
  Int128 d;                       // twice the area, in units squared
  Int128 t0, t1, t2, t3, t4, t5;  // over D^2; a plane's t3 to t5 are zero

  static Truth of(std::array<ScreenPoint, 3> p, const SixSamples& i) {
    const Int128 x2 = p[1].x - p[0].x, y2 = p[1].y - p[0].y, x3 = p[2].x - p[0].x, y3 = p[2].y - p[0].y;
    const Int128 d = x2 * y3 - y2 * x3;
    const Int128 c2 = 4 * Int128{i.edge12} - 3 * Int128{i.vertex[0]} - i.vertex[1];
    const Int128 c3 = 4 * Int128{i.edge13} - 3 * Int128{i.vertex[0]} - i.vertex[2];
    const Int128 q2 = 2 * (Int128{i.vertex[0]} + i.vertex[1] - 2 * Int128{i.edge12});
    const Int128 q3 = 2 * (Int128{i.vertex[0]} + i.vertex[2] - 2 * Int128{i.edge13});
    const Int128 b = 4 * (Int128{i.edge23} - i.edge12 - i.edge13 + i.vertex[0]);
    return {p,
            d,
            i.vertex[0] * d * d,
            (c3 * x2 - c2 * x3) * d,
            (c2 * y3 - c3 * y2) * d,
            (q2 * x3 - b * x2) * x3 + q3 * x2 * x2,
            -2 * q2 * x3 * y3 + b * (x2 * y3 + x3 * y2) - 2 * q3 * x2 * y2,
            (q2 * y3 - b * y2) * y3 + q3 * y2 * y2};
  }
  /// value - truth, in units.
  double error(std::int64_t value, std::int64_t x, std::int64_t y) const {
    const Int128 u = x * c_unit + c_unit / 2 - points[0].x, v = y * c_unit + c_unit / 2 - points[0].y;
    const Int128 truth = t0 + t2 * u + t1 * v + (t5 * u + t4 * v) * u + t3 * v * v;
    return static_cast<double>(value * d * d - truth) / static_cast<double>(d * d);
  }
};

// A triangle with the most steps: its start edge leans left and carries on every line, and the span runs back
// over all carries.
constexpr std::array<ScreenPoint, 3> c_longest_walk = {
    {{1, 0}, {c_side * c_unit, c_side* c_unit}, {0, c_side* c_unit}}};
// The same without carries: lines + pixels.
constexpr std::array<ScreenPoint, 3> c_plain_walk = {
    {{0, 0}, {c_side * c_unit, c_side* c_unit}, {0, c_side* c_unit}}};

// The largest error on a walk and its pixel.
struct Worst {
  double error = 0;  ///< units
  std::int64_t x = 0, y = 0;
  void see(double e, std::int64_t px, std::int64_t py) {
    if (std::fabs(e) > std::fabs(error)) error = e, x = px, y = py;
  }
};

// Which lines and spans of the walk are drawn: all, or every 97th and those near the far end.
constexpr std::int64_t c_every = 1, c_seldom = 97;

// Steps a golden interpolator over the triangle's only walk in preset exact.
template <class Interpolator, class Error>
Worst drawn(const Walk& walk, Interpolator& interpolator, std::int64_t stride, Error&& error) {
  std::vector<std::uint32_t> words;
  InitVector init(words, Exact::c_init_header_bits);
  put_header(init, 0, walk, {0, 0, 0, 0});
  golden::TriangleWalker<Exact> walker;
  walker.line_load(words);
  Worst worst;
  for (std::int64_t line = 0;; ++line) {
    if (!walker.line_empty() && (line % stride == 0 || walker.line_last())) {
      interpolator.span_load();
      const std::int64_t way = walker.backward() ? -1 : 1, stop = walker.stop().value();
      for (std::int64_t x = walker.start().value(); x != stop; x += way) {
        if (x % stride == 0 || x + way == stop)
          worst.see(error(interpolator.value().value(), x, walker.y()), x, walker.y());
        interpolator.span_step();
      }
    }
    if (walker.line_last()) return worst;
    const bool carry = walker.carry();
    walker.line_step();
    interpolator.line_step(carry);
  }
}

// The words of a channel, at the positions that the interpolator's formats give.
template <class P>
std::vector<std::uint32_t> channel_words(const QuadraticWords& w) {
  using At = typename P::init_channel_at;
  std::vector<std::uint32_t> words(16);
  const auto put = [&](const words::Field& field, Int128 value) {
    words::set_bits(words, field, static_cast<std::uint64_t>(value));
  };
  put(At::value, w.value);
  put(At::dx, w.dx);
  put(At::de0, w.de0);
  put(At::dxx, w.dxx);
  put(At::dxe0, w.dxe0);
  put(At::de0e0, w.de0e0);
  if constexpr (std::is_same_v<P, Exact>) {
    put(At::de1, w.de1);
    put(At::dxe1, w.dxe1);
    put(At::de0e1, w.de0e1);
    put(At::de1e1, w.de1e1);
  }
  return words;
}

// Random samples in [0, 255]: those with the largest error of the rounded words at the far end of the walk.
struct Case {
  SixSamples samples;
  QuadraticWords words;
  double predicted = 0;  // units
};
std::string text_of(const SixSamples& s, int fraction_bits) {
  const auto sample = [&](std::int64_t v) {
    return fmt::format("{}", std::ldexp(static_cast<double>(v), -fraction_bits));
  };
  return fmt::format("samples {} {} {}, {} {} {}", sample(s.vertex[0]), sample(s.vertex[1]),
                     sample(s.vertex[2]), sample(s.edge12), sample(s.edge13), sample(s.edge23));
}

Case worst_case(std::array<ScreenPoint, 3> points, const Walk& walk, int fraction_bits, int tries,
                const WalkLine& line, std::int64_t steps) {
  constexpr int c_sample_bits = 8;  // few bits, so that the samples are easy to read
  const QuadraticStart start = QuadraticFit(points, c_unit_bits).at(difference_start(walk));
  std::mt19937_64 random(1);
  Case best;
  for (int i = 0; i < tries; ++i) {
    const auto sample = [&] {
      return static_cast<std::int64_t>(random() % ((255ULL << c_sample_bits) + 1))
             << (fraction_bits - c_sample_bits);
    };
    SixSamples s{{sample(), sample(), sample()}, sample(), sample(), sample()};
    const QuadraticWords w = start.words(s, 0);
    // Newton's form: L lines, C of them with a carry, and K steps of a span.
    const Int128 l = line.steps, c = line.carries, k = steps, way = walk.backward ? -1 : 1;
    const Int128 xx = w.dxx, xe = way * w.dxe0, dx_right = walk.backward ? w.dxx - w.dx : w.dx;
    const Int128 along =
        w.value + l * w.de0 + l * (l - 1) / 2 * w.de0e0 + c * dx_right + c * (c - 1) / 2 * xx + l * c * xe;
    const Int128 dx_there = w.dx + l * w.dxe0 + c * way * xx;
    const Int128 value = along + k * dx_there + k * (k - 1) / 2 * xx;
    const std::int64_t x = line.walk.start.pixel + static_cast<std::int64_t>(k * way);
    const double error =
        std::fabs(Truth::of(points, s).error(static_cast<std::int64_t>(value), x, line.walk.y));
    if (error > best.predicted) best = {s, w, error};
  }
  return best;
}

Walk only_walk(std::array<ScreenPoint, 3> points, FrameSize frame) {
  return plan_walks(points, c_unit_bits, frame).front();
}

constexpr FrameSize c_frame{c_side, c_side};

// Holds for any coefficients: the errors of the words in Newton's form. L: lines. K: steps of the span; the
// carries of the edge count with it, against it if spans run backward, so K may be negative.
std::string quadratic_script(int fraction, double limit, double lines, double steps) {
  return fmt::format(
      "@fx = fixed<-{},ne>;\n"
      "v = fx(V); de = fx(DE); dede = fx(DEDE); dx = fx(DX); dxde = fx(DXDE); dxx = fx(DXX);\n"
      "hardware = v + L * de + S * dede + K * dx + P * dxde + T * dxx;\n"
      "exact = V + L * DE + S * DEDE + K * DX + P * DXDE + T * DXX;\n"
      "{{ L in [0, {}] /\\ S in [0, {}] /\\ |K| <= {} /\\ |P| <= {} /\\ T in [0, {}]\n"
      "  -> |hardware - exact| <= {} }}\n"
      "hardware - exact -> (v - V) + L * (de - DE) + S * (dede - DEDE) + K * (dx - DX) + P * (dxde - DXDE) + "
      "T * (dxx - DXX);\n",
      fraction, lines, lines * (lines - 1) / 2, steps, lines * steps, steps * (steps - 1) / 2, limit);
}
std::string plane_script(int fraction, double limit, double lines, double steps) {
  return fmt::format(
      "@fx = fixed<-{},ne>;\n"
      "z = fx(Z); de = fx(DE); dx = fx(DX);\n"
      "hardware = z + L * de + K * dx;\n"
      "exact = Z + L * DE + K * DX;\n"
      "{{ L in [0, {}] /\\ |K| <= {} -> |hardware - exact| <= {} }}\n"
      "hardware - exact -> (z - Z) + L * (de - DE) + K * (dx - DX);\n",
      fraction, lines, steps, limit);
}

constexpr double c_lines = c_side - 1, c_pixels = c_side - 1, c_carries = c_side - 1;

// A triangle through fit and golden interpolator. Every pixel is compared with exact rationals. Preset
// published has no carries, so its start edge is vertical.
template <class P>
Finding intensity(const Context& context, const Stated& stated) {
  constexpr bool c_exact = std::is_same_v<P, Exact>;
  constexpr int c_fraction = P::c_intensity_fraction_bits;
  const auto& points = c_exact ? c_longest_walk : c_plain_walk;
  const Walk walk = only_walk(points, c_frame);
  const WalkLine last = line_of(walk, c_side - 1);
  const Case worst = worst_case(points, walk, c_fraction, context.quick ? 20'000 : 400'000, last,
                                c_side - (c_exact ? 2 : 1));
  golden::QuadraticInterpolator<P> interpolator;
  interpolator.line_load(channel_words<P>(worst.words), 0);
  const Truth truth = Truth::of(points, worst.samples);
  const Worst found =
      drawn(walk, interpolator, context.quick ? c_seldom : c_every,
            [&](std::int64_t v, std::int64_t x, std::int64_t y) { return truth.error(v, x, y); });
  Finding finding;
  finding.worst = std::ldexp(std::fabs(found.error), -c_fraction);
  finding.where =
      fmt::format("pixel ({}, {}) of the triangle ({}/16, 0) (4096, 4096) (0, 4096), {} carries, {}", found.x,
                  found.y, points[0].x, last.carries, text_of(worst.samples, c_fraction));
  if (c_fraction != stated.format.fraction_bits) finding.failure = "make tables has not been run";
  prove(context,
        quadratic_script(c_fraction, stated.bound.value, c_lines, c_pixels + (c_exact ? c_carries : 0)),
        stated.bound.value, finding);
  return finding;
}

// The sum of the absolute weights of a quadratic's six samples, over the triangle: on small boxes, with the
// largest value of each shape function.
Finding sample_weights(const Context&, const Stated& stated) {
  // |l (2l - 1)| and 4 l m on boxes of two barycentric coordinates.
  constexpr int c_cells = 3000;
  const auto vertex = [](double low, double high) {
    double most = std::max(std::fabs(low * (2 * low - 1)), std::fabs(high * (2 * high - 1)));
    if (low <= 0.25 && high >= 0.25) most = std::max(most, 0.125);
    return most;
  };
  double bound = 0;
  for (int i = 0; i < c_cells; ++i)
    for (int j = 0; i + j < c_cells; ++j) {
      const double a0 = double(i) / c_cells, a1 = double(i + 1) / c_cells, b0 = double(j) / c_cells,
                   b1 = double(j + 1) / c_cells, c0 = std::max(0.0, 1 - a1 - b1), c1 = 1 - a0 - b0;
      bound = std::max(bound,
                       vertex(a0, a1) + vertex(b0, b1) + vertex(c0, c1) + 4 * (a1 * b1 + a1 * c1 + b1 * c1));
    }
  // At the centre each vertex has the weight -1/9, each edge 4/9.
  const double centre = 3.0 / 9 + 3 * 4.0 / 9;
  return {.worst = centre * stated.format.unit() / 2,
          .where = "the triangle's centre, samples at odd half units",
          .proved = bound * stated.format.unit() / 2};
}

// Depth, or a plane of N, P and 1/w.
template <class Interpolator, int Bits>
Finding plane_finding(const Context& context, int fraction, double scale, double limit,
                      std::int64_t largest) {
  const Walk walk = only_walk(c_longest_walk, c_frame);
  const WalkLine last = line_of(walk, c_side - 1);
  const DifferenceStart start = difference_start(walk);
  const std::array<ScreenPoint, 3>& p = c_longest_walk;
  std::mt19937_64 random(5);
  std::array<std::int64_t, 3> best{};
  DepthWords words{};
  double most = 0;
  Int128 best_u = 0, best_v = 0;
  const Int128 d = Int128{p[1].x - p[0].x} * (p[2].y - p[0].y) - Int128{p[1].y - p[0].y} * (p[2].x - p[0].x);
  const auto error = [&](const std::array<std::int64_t, 3>& z, Int128 zu, Int128 zv, std::int64_t value,
                         std::int64_t x, std::int64_t y) {
    const Int128 u = x * c_unit + c_unit / 2 - p[0].x, v = y * c_unit + c_unit / 2 - p[0].y;
    return static_cast<double>(value * d - (z[0] * d + zu * u + zv * v)) / static_cast<double>(d);
  };
  for (int i = 0; i < (context.quick ? 20'000 : 200'000); ++i) {
    std::array<std::int64_t, 3> z;
    for (std::int64_t& depth : z)
      depth = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(largest));
    const DepthWords w = DepthFit(p, c_unit_bits, z).words(start, 0);
    const Int128 zu = Int128{z[1] - z[0]} * (p[2].y - p[0].y) - Int128{z[2] - z[0]} * (p[1].y - p[0].y);
    const Int128 zv = Int128{z[2] - z[0]} * (p[1].x - p[0].x) - Int128{z[1] - z[0]} * (p[2].x - p[0].x);
    const Int128 value =
        w.value + (last.steps - last.carries) * w.de0 + last.carries * w.de1 + (c_side - 2) * w.dx;
    const double e =
        std::fabs(error(z, zu, zv, static_cast<std::int64_t>(value),
                        last.walk.start.pixel + (walk.backward ? -1 : 1) * (c_side - 2), c_side - 1));
    if (e > most) most = e, best = z, words = w, best_u = zu, best_v = zv;
  }
  Interpolator interpolator;
  const auto word = [](Int128 v) { return words::Word<Bits>::from_bits(static_cast<std::uint64_t>(v)); };
  interpolator.line_load(word(words.value), word(words.dx), word(words.de0), word(words.de1));
  const Worst found = drawn(
      walk, interpolator, context.quick ? c_seldom : c_every,
      [&](std::int64_t v, std::int64_t x, std::int64_t y) { return error(best, best_u, best_v, v, x, y); });
  Finding finding;
  finding.worst = std::fabs(found.error) * scale;
  finding.where =
      fmt::format("pixel ({}, {}) of the triangle (1/16, 0) (4096, 4096) (0, 4096), values {}, {}, {} units",
                  found.x, found.y, best[0], best[1], best[2]);
  prove(context, plane_script(fraction, limit, c_lines, c_carries + c_pixels), limit, finding);
  return finding;
}

Finding depth(const Context& context, const Stated& stated) {
  return plane_finding<golden::PlaneInterpolator<Exact::c_depth_sum_bits>, Exact::c_depth_sum_bits>(
      context, stated.format.fraction_bits, stated.format.unit(), stated.bound.value,
      std::int64_t{1} << (24 + stated.format.fraction_bits));
}

template <class P>
Finding plane(const Context& context, const Stated& stated) {
  const double step_of_vector = std::ldexp(1.0, -P::c_vector_fraction_bits);
  Finding finding = plane_finding<golden::PlaneInterpolator<P::c_plane_sum_bits>, P::c_plane_sum_bits>(
      context, stated.format.fraction_bits, stated.format.unit() / step_of_vector,
      stated.bound.value * step_of_vector, std::int64_t{1} << stated.format.fraction_bits);
  if (finding.proved > 0) finding.proved = stated.bound.value;
  return finding;
}

// Start and slope of a published edge, each with the largest rounding error, in the golden walker's adder.
Finding edge(const Context& context, const Stated& stated) {
  constexpr int c_fraction = Published::c_edge_x_fraction_bits;
  Finding finding;
  std::mt19937_64 random(3);
  for (int i = 0; i < 2000; ++i) {
    // Real edges between whole pixels: x0 + dx/dy.
    const auto x0 = static_cast<double>(random() % 4096), x1 = static_cast<double>(random() % 4096);
    const auto lines = static_cast<std::int64_t>(1 + random() % 4095);
    const long double slope = (static_cast<long double>(x1) - x0) / static_cast<long double>(lines);
    golden::LineInterpolator<Published::c_edge_x_bits> x;
    using Word = words::Word<Published::c_edge_x_bits>;
    x.load(
        Word::from_bits(static_cast<std::uint64_t>(wrapped_word(x0, c_fraction, Published::c_edge_x_bits))));
    const Word step = Word::from_bits(
        static_cast<std::uint64_t>(wrapped_word(slope, c_fraction, Published::c_edge_x_bits)));
    for (std::int64_t line = 0; line < lines; ++line) x.step(step);
    const double error = std::fabs(std::ldexp(static_cast<double>(x.value().value()), -c_fraction) - x1);
    keep_worst(finding, error, [&] { return fmt::format("x from {} to {} in {} lines", x0, x1, lines); });
  }
  prove(context, plane_script(stated.format.fraction_bits, stated.bound.value, c_lines, 0),
        stated.bound.value, finding);
  return finding;
}

}  // namespace

std::vector<Check> difference_checks() {
  return {
      {"both", "depth_sum", "", "Gappa; a triangle through setup and golden interpolator", depth},
      {"both", "intensity", "", "Gappa; a triangle through setup and golden interpolator",
       of_preset(intensity<Exact>, intensity<Published>)},
      {"both", "intensity", "samples", "intervals over the whole triangle", sample_weights},
      {"both", "plane_sum", "", "Gappa; a triangle through setup and golden interpolator",
       of_preset(plane<Exact>, plane<Published>)},
      {"published", "edge_x", "", "Gappa; edges between whole pixels by the golden adder", edge},
  };
}

}  // namespace halfway::bounds

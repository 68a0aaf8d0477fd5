// SPDX-License-Identifier: Apache-2.0
// Compares QuadraticFit and DepthFit with the 6x6 and 3x3 systems solved in rationals, and the golden model's
// registers with PixelFit's colours, without tolerance. tb/specification/bounds and the searches and hard
// cases of tb/specification/hard_cases compare the golden model with the quadratic at every pixel.
#include "setup/quadratic_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

#include "common/test/gmp_numbers.hpp"
#include "golden/quadratic_shader.hpp"
#include "setup/test/random_triangles.hpp"

namespace halfway {
namespace {

using words::Exact;

constexpr int c_fraction = Exact::c_intensity_fraction_bits;
constexpr std::int64_t c_largest_sample_word = std::int64_t{1023} << c_fraction;
constexpr FrameSize c_largest_frame = {4096, 4096};

/// Solves A x = b by elimination. A must be regular.
template <std::size_t N>
std::array<mpq_class, N> solved(std::array<std::array<mpq_class, N + 1>, N> rows) {
  for (std::size_t i = 0; i < N; ++i) {
    std::size_t pivot = i;
    while (rows[pivot][i] == 0) ++pivot;
    std::swap(rows[i], rows[pivot]);
    for (std::size_t j = 0; j < N; ++j) {
      if (j == i || rows[j][i] == 0) continue;
      const mpq_class factor = rows[j][i] / rows[i][i];
      for (std::size_t k = i; k <= N; ++k) rows[j][k] -= factor * rows[i][k];
    }
  }
  std::array<mpq_class, N> x;
  for (std::size_t i = 0; i < N; ++i) x[i] = rows[i][N] / rows[i][i];
  return x;
}

/// a x^2 + b xy + c y^2 + d x + e y + f; x and y in the triangle's units, relative to its first vertex.
struct Quadratic {
  std::array<mpq_class, 6> k;
  mpq_class at(const mpq_class& x, const mpq_class& y) const {
    return (k[0] * x + k[1] * y + k[3]) * x + (k[2] * y + k[4]) * y + k[5];
  }
};

Quadratic through(const Points& p, const SixSamples& s) {
  const auto point = [&](int i, int j) {
    const auto from_first = [](std::int64_t sum, std::int32_t first) -> mpq_class {
      return mpq_class(static_cast<long>(sum - 2 * std::int64_t{first})) / 2;
    };
    return std::pair(from_first(std::int64_t{p[i].x} + p[j].x, p[0].x),
                     from_first(std::int64_t{p[i].y} + p[j].y, p[0].y));
  };
  const std::array<std::pair<mpq_class, mpq_class>, 6> at = {point(0, 0), point(1, 1), point(2, 2),
                                                             point(0, 1), point(0, 2), point(1, 2)};
  const std::array<std::int64_t, 6> sample = {s.vertex[0], s.vertex[1], s.vertex[2],
                                              s.edge12,    s.edge13,    s.edge23};
  std::array<std::array<mpq_class, 7>, 6> rows;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& [x, y] = at[i];
    rows[i] = {x * x, x * y, y * y, x, y, 1, static_cast<long>(sample[i])};
  }
  return {solved<6>(rows)};
}

std::int64_t twice_area(const Points& p) {
  return std::int64_t{p[1].x - p[0].x} * (p[2].y - p[0].y) -
         std::int64_t{p[1].y - p[0].y} * (p[2].x - p[0].x);
}

/// The centre of a pixel relative to the first vertex, in the triangle's units.
std::int64_t centre(std::int64_t pixel, std::int32_t origin, int unit_bits) {
  const std::int64_t unit = std::int64_t{1} << unit_bits;
  return pixel * unit + unit / 2 - origin;
}

SixSamples random_samples(RandomTriangles& random, int round) {
  std::array<std::int64_t, 6> s;
  for (std::int64_t& v : s)
    v = (std::int64_t{random.within(0, 1023)} << c_fraction) * (random.within(0, 3) > 0);
  if (round % 3 == 0)  // every control point at its extreme
    for (int i = 0; i < 6; ++i) s[i] = round / 3 >> i & 1 ? c_largest_sample_word : 0;
  if (round % 3 == 1)
    for (std::int64_t& v : s)
      v = std::min(c_largest_sample_word, v + random.within(0, (1 << c_fraction) - 1));
  return {{s[0], s[1], s[2]}, s[3], s[4], s[5]};
}

TEST(QuadraticFit, EachWordIsTheRationalRoundedOnce) {
  int slivers = 0, backward = 0;
  for (int unit_bits = 4; unit_bits <= 9; ++unit_bits)
    for (const TriangleKind kind : c_triangle_kinds) {
      RandomTriangles random(static_cast<unsigned>(10 * unit_bits + static_cast<int>(kind)));
      for (int round = 0, done = 0; round < 400 && done < 8; ++round) {
        const Points p = random.next(kind, unit_bits, c_largest_frame, unit_bits - 4);
        const Walks walks = plan_walks(p, unit_bits, c_largest_frame);
        if (walks.empty()) continue;
        ++done;
        const SixSamples samples = random_samples(random, done + 7 * unit_bits);
        const Quadratic quadratic = through(p, samples);
        slivers += std::abs(twice_area(p)) < (std::int64_t{100} << unit_bits);
        for (const Walk& walk : walks) {
          backward += walk.backward;
          const DifferenceStart start{walk.start.pixel, walk.y, walk.start.quotient, walk.backward};
          const std::int64_t half = std::int64_t{1} << (c_fraction - 1);
          const QuadraticWords w = QuadraticFit(p, unit_bits).at(start).words(samples, half);
          // Forward differences by definition: differences of the quadratic at pixels from the first one on.
          const auto at = [&](std::int64_t dx, std::int64_t dy) {
            return quadratic.at(static_cast<long>(centre(start.x + dx, p[0].x, unit_bits)),
                                static_cast<long>(centre(start.y + dy, p[0].y, unit_bits)));
          };
          const std::int64_t q = start.quotient, s = walk.backward ? -1 : 1;
          const auto step = [&](std::int64_t ax, std::int64_t ay) -> mpq_class {
            return at(ax, ay) - at(0, 0);
          };
          const auto second = [&](std::int64_t ax, std::int64_t ay, std::int64_t bx,
                                  std::int64_t by) -> mpq_class {
            return at(ax + bx, ay + by) - at(ax, ay) - at(bx, by) + at(0, 0);
          };
          ASSERT_EQ(to_mpz(w.value - half), rounded(at(0, 0)));
          ASSERT_EQ(to_mpz(w.dx), rounded(step(s, 0)));
          ASSERT_EQ(to_mpz(w.de0), rounded(step(q, 1)));
          ASSERT_EQ(to_mpz(w.dxx), rounded(second(s, 0, s, 0)));
          ASSERT_EQ(to_mpz(w.de0e0), rounded(second(q, 1, q, 1)));
          // The mixed difference is rounded in forward direction, for spans in either direction.
          const mpz_class xe0 = rounded(second(1, 0, q, 1));
          ASSERT_EQ(to_mpz(w.dxe0), s * xe0);
          // The other words are sums of these, as for a quadratic with integer coefficients.
          const Int128 forward_x = walk.backward ? w.dxx - w.dx : w.dx, forward_xe0 = s * w.dxe0;
          ASSERT_TRUE(w.de1 == w.de0 + forward_x + forward_xe0);
          ASSERT_TRUE(w.dxe1 == s * (forward_xe0 + w.dxx));
          ASSERT_TRUE(w.de0e1 == w.de0e0 + forward_xe0);
          ASSERT_TRUE(w.de1e1 == w.de0e0 + 2 * forward_xe0 + w.dxx);
        }
      }
    }
  EXPECT_GT(slivers, 50);
  EXPECT_GT(backward, 100);
}

TEST(DepthFit, EachWordIsTheRationalRoundedOnce) {
  for (const TriangleKind kind : c_triangle_kinds) {
    RandomTriangles random(static_cast<unsigned>(kind));
    for (int round = 0; round < 60; ++round) {
      const int level = round % 6, unit_bits = 4 + level;
      const Points p = random.next(kind, unit_bits, c_largest_frame, level);
      if (twice_area(p) == 0) continue;
      const std::array<std::int64_t, 3> z = {
          random.within(1, (1 << 24) - 3) * (std::int64_t{1} << 15),
          random.within(1, (1 << 24) - 3) * (std::int64_t{1} << 15) + 12345,
          random.within(1, 2) * (std::int64_t{1} << 15)};
      std::array<std::array<mpq_class, 4>, 3> rows;
      for (std::size_t i = 0; i < 3; ++i)
        rows[i] = {p[i].x - p[0].x, p[i].y - p[0].y, 1, static_cast<long>(z[i])};
      const std::array<mpq_class, 3> plane = solved<3>(rows);
      for (const Walk& walk : plan_walks(p, unit_bits, c_largest_frame)) {
        const DifferenceStart start{walk.start.pixel, walk.y, walk.start.quotient, walk.backward};
        const DepthWords w = DepthFit(p, unit_bits, z).words(start, 1 << 14);
        const long unit = 1L << unit_bits;
        const mpq_class value = plane[0] * static_cast<long>(centre(start.x, p[0].x, unit_bits)) +
                                plane[1] * static_cast<long>(centre(start.y, p[0].y, unit_bits)) + plane[2];
        const mpz_class step_x = rounded(plane[0] * unit);
        ASSERT_EQ(to_mpz(w.value - (1 << 14)), rounded(value));
        ASSERT_EQ(to_mpz(w.dx), walk.backward ? mpz_class(-step_x) : step_x);
        ASSERT_EQ(to_mpz(w.de0), rounded((plane[0] * static_cast<long>(start.quotient) + plane[1]) * unit));
        ASSERT_EQ(to_mpz(w.de1), to_mpz(w.de0) + step_x);
      }
    }
  }
}

void put_words(InitVector& init, const QuadraticWords& w) {
  using At = Exact::init_channel_at;
  constexpr int c_low = Exact::c_init_header_bits;
  init.put(At::value, w.value, c_low);
  init.put(At::dx, w.dx, c_low);
  init.put(At::de0, w.de0, c_low);
  init.put(At::de1, w.de1, c_low);
  init.put(At::dxx, w.dxx, c_low);
  init.put(At::dxe0, w.dxe0, c_low);
  init.put(At::dxe1, w.dxe1, c_low);
  init.put(At::de0e0, w.de0e0, c_low);
  init.put(At::de0e1, w.de0e1, c_low);
  init.put(At::de1e1, w.de1e1, c_low);
}

/// Compares the colour register at each pixel with the colours given for the pixels.
class PixelComparison {
 public:
  PixelComparison(const std::vector<Pixel>& pixels, const std::vector<std::int64_t>& colours)
      : pixels_(pixels), colours_(colours) {}
  template <class Shader>
  void line(const Shader&) {}
  template <class Shader>
  void span(const Shader& shader, golden::SpanXWord x) {
    const auto at = std::ranges::find(pixels_, Pixel{x.value(), shader.walker().y()});
    ASSERT_NE(at, pixels_.end());
    ASSERT_EQ(shader.channel(0).value().value(), colours_[static_cast<std::size_t>(at - pixels_.begin())]);
    ++drawn_;
  }
  std::size_t drawn() const { return drawn_; }

 private:
  const std::vector<Pixel>& pixels_;
  const std::vector<std::int64_t>& colours_;
  std::size_t drawn_ = 0;
};

// Random colours at the pixels of random triangles of at most 2 pixels: each pixel's colour register holds
// its colour, bit for bit. The frame cuts some of them.
TEST(PixelFit, EachPixelHasItsColourExactly) {
  using Shader = golden::QuadraticShader<Exact, 1>;
  constexpr FrameSize c_tiny_frame{5, 5};
  RandomTriangles random(12);
  // Lines, pixels of the first line, pixels of the last line.
  std::set<std::array<std::size_t, 3>> shapes;
  int backward = 0, diagonal = 0, moved = 0;  // moved: the second line starts at another column
  for (int round = 0; round < 600'000; ++round) {
    const int unit_bits = 4 + round % 6, side = 2 << unit_bits;
    const int left = random.within(-side, 5 * side / 2), top = random.within(-side, 5 * side / 2);
    Points p;
    for (ScreenPoint& q : p) q = {left + random.within(0, side), top + random.within(0, side)};
    const Walks walks = plan_walks(p, unit_bits, c_tiny_frame);
    const std::vector<Pixel> pixels = covered_pixels(p, unit_bits, c_tiny_frame);
    ASSERT_EQ(walks.empty(), pixels.empty());
    if (walks.empty()) continue;
    std::vector<std::int64_t> colours;
    for (std::size_t i = 0; i < pixels.size(); ++i)
      colours.push_back(round % 4 == 0 ? random.within(0, 1) * c_largest_sample_word
                                       : (std::int64_t{random.within(0, 1022)} << c_fraction) +
                                             random.within(0, 1 << 28));
    const PixelFit fit(pixels);
    PixelComparison comparison(pixels, colours);
    for (const Walk& walk : walks) {
      std::vector<std::uint32_t> words;
      InitVector init(words, Shader::c_init_bits);
      put_header(init, 0, walk, {});
      put_words(init, fit.words(colours, {walk.start.pixel, walk.y, walk.start.quotient, walk.backward}, 0));
      Shader shader;
      shader.draw(words, [](const Fragment&) {}, comparison);
      if (HasFatalFailure()) return;
      backward += walk.backward;
      moved += walk.upper_lines + walk.lower_lines > 1 && (walk.start.quotient != 0 || walk.start.carry);
    }
    ASSERT_EQ(comparison.drawn(), pixels.size());
    const auto lines = static_cast<std::size_t>(pixels.back().y - pixels.front().y + 1);
    shapes.insert({lines, static_cast<std::size_t>(std::ranges::count(pixels, pixels.front().y, &Pixel::y)),
                   static_cast<std::size_t>(std::ranges::count(pixels, pixels.back().y, &Pixel::y))});
    diagonal += pixels.size() == 2 && lines == 2 && pixels[0].x != pixels[1].x;
  }
  EXPECT_EQ(shapes,
            (std::set<std::array<std::size_t, 3>>{{1, 1, 1}, {1, 2, 2}, {2, 1, 1}, {2, 1, 2}, {2, 2, 1}}));
  EXPECT_GT(backward, 1000);
  EXPECT_GT(diagonal, 100);
  EXPECT_GT(moved, 1000);
}

}  // namespace
}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// Tests the quadratic paper's own trace, and compares the forward differences with their polynomial.
#include "golden/quadratic_interpolator.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

namespace halfway::golden {
namespace {

template <class Preset>
using Block = std::array<std::uint32_t, (Preset::c_init_channel_bits + 31) / 32>;

// Quadratic paper, figure 7: 32 bits, 20 of them fraction; line k has k pixels after its first.
TEST(QuadraticInterpolator, ReproducesThePublishedTrace) {
  using At = Published::init_channel_at;
  Block<Published> init{};
  set_bits(init, At::value, 0x06AFFFF8);
  set_bits(init, At::dx, 0x00150725);
  set_bits(init, At::de0, 0xFFFD1688);
  set_bits(init, At::dxx, 0xFFFFFB1E);
  set_bits(init, At::dxe0, 0xFFFFF45E);
  set_bits(init, At::de0e0, 0xFFFFEF9E);
  QuadraticInterpolator<Published> interpolator;
  interpolator.line_load(init, 0);
  struct Line {
    std::uint32_t de0, dx;
    std::vector<std::uint32_t> values, steps;
  };
  const std::array<Line, 4> lines = {{
      {0xFFFD1688, 0x00150725, {0x06AFFFF8}, {0x00150725}},
      {0xFFFD0626, 0x0014FB83, {0x06AD1680, 0x06C21203}, {0x0014FB83, 0x0014F6A1}},
      {0xFFFCF5C4, 0x0014EFE1, {0x06AA1CA6, 0x06BF0C87, 0x06D3F786}, {0x0014EFE1, 0x0014EAFF, 0x0014E61D}},
      {0xFFFCE562, 0x0014E43F, {0x06A7126A, 0x06BBF6A9}, {0x0014E43F}},
  }};
  for (std::size_t l = 0; l < lines.size(); ++l) {
    EXPECT_EQ(interpolator.edge_value().bits(), lines[l].values[0]) << "line " << l;
    EXPECT_EQ(interpolator.edge_de0().bits(), lines[l].de0) << "line " << l;
    EXPECT_EQ(interpolator.edge_dx().bits(), lines[l].dx) << "line " << l;
    interpolator.span_load();
    for (std::size_t x = 0; x < lines[l].values.size(); ++x) {
      EXPECT_EQ(interpolator.value().bits(), lines[l].values[x]) << "line " << l << " pixel " << x;
      if (x < lines[l].steps.size()) {
        EXPECT_EQ(interpolator.dx().bits(), lines[l].steps[x]) << "line " << l << " pixel " << x;
      }
      interpolator.span_step();
    }
    interpolator.line_step(false);
  }
}

// I(x, y) = a + bx + cy + dx^2 + exy + fy^2 with integer coefficients, all modulo 2^W, along an edge of step
// (q, 1) or (q + 1, 1), with spans in both directions: the words equal the polynomial even where they wrap.
TEST(QuadraticInterpolator, FollowsAPolynomialModuloTheWordsWidth) {
  std::mt19937_64 random(3);
  using At = Exact::init_channel_at;
  constexpr int c_block_low = 77;  // a block may start at any bit
  for (int round = 0; round < 300; ++round) {
    std::array<std::uint64_t, 6> k;
    for (std::uint64_t& coefficient : k) coefficient = random();
    const auto at = [&](std::int64_t px, std::int64_t py) {
      const std::uint64_t x = static_cast<std::uint64_t>(px), y = static_cast<std::uint64_t>(py);
      return k[0] + k[1] * x + k[2] * y + k[3] * x * x + k[4] * x * y + k[5] * y * y;
    };
    const std::int64_t q = std::uniform_int_distribution<std::int64_t>(-40, 40)(random);
    const std::int64_t s = round % 2 ? 1 : -1;
    struct Step {
      std::int64_t x, y;
    };
    const Step x{s, 0}, e0{q, 1}, e1{q + 1, 1};
    const auto first = [&](Step a) { return at(a.x, a.y) - at(0, 0); };
    const auto second = [&](Step a, Step b) { return at(a.x + b.x, a.y + b.y) - at(a.x, a.y) - first(b); };
    std::array<std::uint32_t, 16> init{};
    const auto put = [&](const Field& field, std::uint64_t value) {
      set_bits(init, field, value, c_block_low);
    };
    put(At::value, at(0, 0));
    put(At::dx, first(x));
    put(At::de0, first(e0));
    put(At::de1, first(e1));
    put(At::dxx, second(x, x));
    put(At::dxe0, second(x, e0));
    put(At::dxe1, second(x, e1));
    put(At::de0e0, second(e0, e0));
    put(At::de0e1, second(e0, e1));
    put(At::de1e1, second(e1, e1));
    QuadraticInterpolator<Exact> interpolator;
    interpolator.line_load(init, c_block_low);
    std::int64_t px = 0;
    for (std::int64_t py = 0; py < 30; ++py) {
      ASSERT_EQ(interpolator.edge_value().bits(), low_bits(at(px, py), Exact::c_intensity_bits));
      interpolator.span_load();
      for (std::int64_t i = 0; i < 10; ++i) {
        ASSERT_EQ(interpolator.value().bits(), low_bits(at(px + s * i, py), Exact::c_intensity_bits))
            << "line " << py << " pixel " << i;
        interpolator.span_step();
      }
      const bool carry = random() % 2;
      interpolator.line_step(carry);
      px += q + (carry ? 1 : 0);
    }
  }
}

}  // namespace
}  // namespace halfway::golden

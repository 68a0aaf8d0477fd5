// SPDX-License-Identifier: Apache-2.0
// Tests angles close to the ends of the bell, powers, records, and sums that would wrap. The colours are
// compared with the papers' formulas in setup/spherical_setup_test.cpp.
#include "golden/spherical_shader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace halfway::golden {
namespace {

constexpr int c_x = 100, c_y = 7;

template <class Preset>
class Drawing {
 public:
  static constexpr bool c_exact = std::is_same_v<Preset, Exact>;
  using At = typename Preset::init_header_at;

  Drawing(const SphericalConfig& config, int lines, int width, bool backward)
      : layout(config),
        shader(config),
        vectors(shader.init_words() * static_cast<std::size_t>(layout.record_bits() == 0 ? 1 : 1 + lines)) {
    const int last = width - (c_exact ? 0 : 1);  // published: spans are inclusive at both ends
    const int stop = c_x + (backward ? -width : last);
    const int shift = c_exact ? 0 : Preset::c_edge_x_fraction_bits;
    put(At::triangle, 5);
    put(At::y, c_y);
    put(At::upper_lines, static_cast<std::uint64_t>(lines));
    put(At::start_x, static_cast<std::uint64_t>(c_x) << shift);
    put(At::upper_x, static_cast<std::uint64_t>(stop) << shift);
    if constexpr (c_exact) put(At::backward, backward);
  }

  void put(const Field& field, std::uint64_t value) { set_bits(std::span(vectors), field, value); }
  std::span<std::uint32_t> record(int line) {
    return std::span(vectors).subspan(shader.init_words() * static_cast<std::size_t>(1 + line));
  }
  std::vector<Fragment> draw() {
    std::vector<Fragment> fragments;
    shader.draw(vectors, [&](const Fragment& f) { fragments.push_back(f); });
    return fragments;
  }

  SphericalLayout<Preset> layout;
  SphericalShader<Preset> shader;
  std::vector<std::uint32_t> vectors;
};

// Of two highlights at their peaks, one is below the light's horizon.
TEST(SphericalShader, EndsAHighlightAtTheHorizon) {
  const auto [a, b] = c_exact_cosine_size;
  Drawing<Exact> d({1, 1, false, true, 1, 2, a, b}, 2, 1, false);
  const std::int64_t one = std::int64_t{1} << Exact::c_angle_fraction_bits;
  for (const auto& [line, angle] : {std::pair{0, one - 1}, std::pair{1, one}}) {
    set_bits(d.record(line), Exact::diffuse_header_at::angle, static_cast<std::uint64_t>(angle),
             d.layout.diffuse_low(0));
    set_bits(d.record(line), Exact::specular_channel_at::factor, 100 << Exact::c_factor_fraction_bits,
             d.layout.specular_low(0) + Exact::c_specular_header_bits);
  }
  const auto fragments = d.draw();
  ASSERT_EQ(fragments.size(), 2U);
  EXPECT_EQ(fragments[0].red, 99);  // 100 times 255 / 256, truncated
  EXPECT_EQ(fragments[1].red, 0);
}

TEST(SphericalShader, PowerWithoutATableIsDark) {
  const auto [a, b] = c_exact_cosine_size;
  for (const auto& [powers, power, bright] :
       {std::tuple{6u, 1u, true}, std::tuple{6u, 3u, false}, std::tuple{6u, 7u, false},
        std::tuple{4u, 0u, true} /* nothing to select */}) {
    Drawing<Exact> d({1, 1, false, true, 1, powers, a, b}, 1, 1, false);
    set_bits(d.record(0), Exact::specular_header_at::power, power, d.layout.specular_low(0));
    set_bits(d.record(0), Exact::specular_channel_at::factor, 100 << Exact::c_factor_fraction_bits,
             d.layout.specular_low(0) + Exact::c_specular_header_bits);
    EXPECT_EQ(d.draw().at(0).red, bright ? 99 : 0) << powers << ' ' << power;
  }
}

TEST(SphericalShader, GroupHoldsARecordForEveryLine) {
  const auto [a, b] = c_exact_cosine_size;
  Drawing<Exact> d({3, 1, true, true, 1, 2, a, b}, 3, 1, false);
  EXPECT_EQ(d.shader.group(d.vectors), 4U);
  d.put(Exact::init_header_at::lower_lines, 9);
  EXPECT_EQ(d.shader.group(d.vectors), 13U);
  d.put(Exact::init_header_at::upper_lines, 0);  // the counter counts a full period
  EXPECT_EQ(d.shader.group(d.vectors), 1U + 8192 + 9);
  for (const SphericalConfig& config :
       {SphericalConfig{3, 0, true, true, 1, 2, a, b}, SphericalConfig{3, 2, false, false, 1, 2, a, b}}) {
    Drawing<Exact> without(config, 3, 4, false);
    EXPECT_EQ(without.layout.record_bits(), 0);
    EXPECT_EQ(without.shader.group(without.vectors), 1U);
    EXPECT_EQ(without.draw().size(), 12U);
  }
}

// A line without pixels has a record, which is skipped. The watch sees each line with pixels and each pixel.
TEST(SphericalShader, SkipsTheRecordsOfEmptyLines) {
  const auto [a, b] = c_exact_cosine_size;
  Drawing<Exact> d({1, 1, true, false, 1, 2, a, b}, 3, 2, false);
  using At = Exact::init_header_at;
  // 2 pixels, none, then 2 pixels next to the first: the lower section starts with the second line.
  d.put(At::upper_lines, 1);
  d.put(At::lower_lines, 2);
  d.put(At::lower_x, c_x);
  d.put(At::lower_quotient, 2);
  for (int line = 0; line < 3; ++line)
    set_bits(d.record(line), Exact::diffuse_channel_at::factor,
             static_cast<std::uint64_t>(10 + line) << Exact::c_factor_fraction_bits,
             Exact::c_diffuse_header_bits);
  struct Watch {
    std::string& seen;
    void line(const SphericalShader<Exact>&) { seen += 'l'; }
    void span(const SphericalShader<Exact>&, SpanXWord) { seen += 's'; }
  };
  std::string seen;
  std::vector<Fragment> fragments;
  d.shader.draw(d.vectors, [&](const Fragment& f) { fragments.push_back(f); }, Watch{seen});
  EXPECT_EQ(seen, "lsslss");
  ASSERT_EQ(fragments.size(), 4U);
  EXPECT_EQ(fragments[0].red, 9);  // 255 / 256 of the factor
  EXPECT_EQ(fragments[3].red, 11);
  EXPECT_EQ(fragments[3].y, c_y + 2);
}

TEST(AngleAddress, IsTheCellOfTheMagnitude) {
  std::mt19937_64 random(1);
  constexpr int c_fraction = Exact::c_angle_fraction_bits;
  const std::int64_t one = std::int64_t{1} << c_fraction;
  using Angle = Word<Exact::c_angle_bits>;
  const auto at = [](std::int64_t v, int bits) {
    return angle_address<Exact>(Angle::from_bits(static_cast<std::uint64_t>(v)), bits);
  };
  for (const int bits : {3, 9, 12}) {
    for (int i = 0; i < 2000; ++i) {
      const auto v = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(one));
      EXPECT_EQ(at(v, bits).address, static_cast<std::uint32_t>((v << bits) / one));
      // The other side of the peak has the same cell, and ends one unit in the last place later.
      EXPECT_EQ(at(-v - 1, bits).address, at(v, bits).address);
    }
    EXPECT_TRUE(at(one - 1, bits).in_range);
    EXPECT_FALSE(at(one, bits).in_range);
    EXPECT_TRUE(at(-one, bits).in_range);
    EXPECT_FALSE(at(-one - 1, bits).in_range);
    EXPECT_FALSE(at(5 * one, bits).in_range);
    EXPECT_FALSE(at(-1024 * one, bits).in_range);
  }
}

// The upper bits of a word select its cell. The address of the table is signed and wraps.
TEST(AngleAddress, WrapsInPresetPublished) {
  using Angle = Word<Published::c_angle_bits>;
  for (int v = -2048; v < 2048; ++v) {
    const auto at = angle_address<Published>(Angle::from_bits(static_cast<std::uint64_t>(v)), 6);
    EXPECT_EQ(at.address, static_cast<std::uint32_t>(static_cast<int>(std::floor(v / 64.0)) & 63));
    EXPECT_TRUE(at.in_range);
  }
}

TEST(SaturatingSum, NeitherWrapsNorExceedsTheLargest) {
  SaturatingSum sum;
  for (int i = 0; i < 255; ++i) sum.add(1 << 16);
  sum.add((1 << 16) - 1);
  EXPECT_EQ(sum.result(16, 8), 255U);
  EXPECT_EQ(sum.result(17, 8), 127U);
  sum.add(1);
  EXPECT_EQ(sum.result(16, 8), 255U);
  for (int i = 0; i < 100; ++i) sum.add(~std::uint32_t{0});  // exceeds 2^32
  EXPECT_EQ(sum.result(16, 8), 255U);
  EXPECT_EQ(sum.result(32, 8), 100U);
}

}  // namespace
}  // namespace halfway::golden

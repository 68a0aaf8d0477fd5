// SPDX-License-Identifier: Apache-2.0
// The golden model draws the same fragments with and without a probe.
#include "golden_run/golden_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "golden/word.hpp"

namespace halfway {
namespace {

template <class Preset>
using HeaderAt = typename Preset::init_header_at;

// Init vectors of random bits, with few lines: registers wrap, spans run in both directions and past the
// frame.
template <class Preset>
void expect_probe_changes_nothing(const HardwareKey& key, bool headers_alone) {
  SCOPED_TRACE(key.name());
  const auto golden = make_golden_model(key);
  const std::size_t words = (golden->init_bits() + 31) / 32;
  std::mt19937 random(20260229);
  std::vector<std::uint32_t> vectors;
  for (int i = 0; i < 6; ++i) {
    std::vector<std::uint32_t> vector(words);
    for (std::uint32_t& word : vector) word = static_cast<std::uint32_t>(random());
    golden::set_bits(vector, HeaderAt<Preset>::upper_lines, 1 + random() % 3);
    std::size_t lines = golden::get_bits(vector, HeaderAt<Preset>::upper_lines);
    if constexpr (std::is_same_v<Preset, golden::Exact>) {
      golden::set_bits(vector, HeaderAt<Preset>::lower_lines, random() % 3);
      lines += golden::get_bits(vector, HeaderAt<Preset>::lower_lines);
    }
    vectors.insert(vectors.end(), vector.begin(), vector.end());
    if (headers_alone) continue;
    for (std::size_t word = 0; word < lines * words; ++word)
      vectors.push_back(static_cast<std::uint32_t>(random()));
  }
  std::vector<Fragment> probed, appended(3);
  std::vector<ProbeEvent> events;
  golden->draw_probed(vectors, probed, events);
  golden->draw(vectors, appended);
  const std::span<const Fragment> drawn = golden->draw(vectors);
  ASSERT_GT(probed.size(), 1000U);
  EXPECT_TRUE(std::equal(drawn.begin(), drawn.end(), probed.begin(), probed.end()));
  EXPECT_TRUE(std::equal(appended.begin() + 3, appended.end(), probed.begin(), probed.end()));
}

TEST(GoldenRun, DrawsTheSameWithAndWithoutProbe) {
  HardwareKey key;
  for (const unsigned channels : {1U, 3U}) {
    key.channels = channels;
    key.preset = Preset::exact;
    expect_probe_changes_nothing<golden::Exact>(key, true);
    key.preset = Preset::published;
    expect_probe_changes_nothing<golden::Published>(key, true);
  }
  key.shader = Shader::spherical;
  for (const unsigned lights : {0U, 1U, 3U})
    for (const bool diffuse : {false, true})
      for (const bool specular : {false, true})
        for (const unsigned highlights : {1U, key.channels}) {
          key.spherical = {lights, diffuse, specular, highlights, 0x16, {9, 8}};
          key.preset = Preset::exact;
          expect_probe_changes_nothing<golden::Exact>(key, !key.spherical.records());
          key.spherical.powers = 2;
          key.spherical.tables = {6, 6};
          key.preset = Preset::published;
          expect_probe_changes_nothing<golden::Published>(key, !key.spherical.records());
        }
}

}  // namespace
}  // namespace halfway

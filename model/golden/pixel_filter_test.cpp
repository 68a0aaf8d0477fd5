// SPDX-License-Identifier: Apache-2.0
// Compares the filter's golden model, strip by strip, with the definition: for each pixel of the whole frame
// the mean over 2x2 pixels in double. All values are multiples of 2^-20 below 2^8, so double is exact.
#include "golden/pixel_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <tuple>
#include <utility>

#include "golden/fragment_output.hpp"

namespace halfway::golden {
namespace {

constexpr int c_lines = 9, c_columns = 23;
constexpr Background c_background = {17, 200, 255};

/// A frame of random objects: a pixel has a list of tokens with their weights.
template <class Preset>
class RandomFrame {
 public:
  using Token = ShadingToken<Preset>;
  struct Object {
    Token token;
    std::uint32_t weight;
  };

  RandomFrame(std::uint32_t subpixels, unsigned seed) : engine_(seed) {
    for (std::uint32_t y = 0; y < c_lines; ++y)
      for (std::uint32_t x = 0; x < c_columns; ++x)
        if (y % 4 != 2 && random() % 8 < (x < 12 ? 7 : 2)) fill({y, x}, subpixels);
  }

  /// The fragments of a strip from column `first` to `last`, in order.
  std::vector<Fragment> strip(PixelFilter<Preset>& filter, std::uint32_t first, std::uint32_t last) const {
    std::vector<Fragment> fragments;
    const auto take = [&](const Token& token, std::uint32_t weight) {
      filter.take(token, weight, [&](const Fragment& f) { fragments.push_back(f); });
    };
    for (std::uint32_t y = 0; y < c_lines; ++y)
      for (std::uint32_t x = first; x <= last; ++x) {
        Token head;
        head.command = x == first ? Command::new_scanline : Command::new_pixel;
        head.y = y;
        head.x = x;
        take(head, 0);
        for (const Object& object : objects(y, x)) take(object.token, object.weight);
      }
    Token end;
    end.command = Command::new_frame;
    take(end, 0);
    return fragments;
  }

  /// The fragments by definition.
  std::vector<Fragment> filtered(int channels, double subpixels, const FilterWeights& weights) const {
    std::vector<Fragment> fragments;
    for (std::uint32_t y = 0; y < c_lines; ++y)
      for (std::uint32_t x = 0; x < c_columns; ++x) {
        const std::pair<std::uint32_t, std::uint32_t> support[] = {
            {y, x}, {y, x - 1}, {y - 1, x}, {y - 1, x - 1}};
        double total = 0, colours[3] = {0, 0, 0};
        const Token* nearest = nullptr;
        for (std::size_t n = 0; n < 4; ++n) {
          if (weights[n] == 0) continue;
          const auto weight = static_cast<double>(weights[n]);
          total += weight;
          const auto& list = objects(support[n].first, support[n].second);
          for (int i = 0; i < 3; ++i) {
            const int channel = channels == 3 ? i : 0;
            colours[i] += weight * colour(list, channel, subpixels);
          }
          if (!list.empty() && (!nearest || list[0].token.z < nearest->z)) nearest = &list[0].token;
        }
        if (!nearest) continue;
        const auto rounded = [&](int i) {
          return static_cast<std::uint8_t>(std::floor(colours[i] / total + 0.5));
        };
        fragments.push_back({nearest->triangle, nearest->z, static_cast<std::uint16_t>(y),
                             static_cast<std::uint16_t>(x), rounded(0), rounded(1), rounded(2)});
      }
    return fragments;
  }

  /// The objects, each alone as a fragment.
  std::vector<Fragment> unfiltered(int channels) const {
    std::vector<Fragment> fragments;
    for (const auto& [place, list] : pixels_)
      fragments.push_back(fragment_output(list.at(0).token, channels));
    return fragments;
  }

 private:
  using At = std::pair<std::uint32_t, std::uint32_t>;  // y, x

  const std::vector<Object>& objects(std::uint32_t y, std::uint32_t x) const {
    static const std::vector<Object> c_nothing;
    const auto at = pixels_.find({y, x});
    return at == pixels_.end() ? c_nothing : at->second;
  }
  static double colour(const std::vector<Object>& objects, int channel, double subpixels) {
    const double one = std::ldexp(1, Preset::c_radiance_fraction_bits);
    double sum = 0, rest = subpixels;
    for (const Object& object : objects) {
      const double radiance = object.token.radiance[static_cast<std::size_t>(channel)] / one;
      sum += object.weight * std::min(radiance - (one > 1 ? 0.5 : 0), 255.0);
      rest -= object.weight;
    }
    return (sum + rest * c_background[static_cast<std::size_t>(channel)]) / subpixels;
  }
  void fill(At at, std::uint32_t subpixels) {
    const std::uint32_t all = random() % 3 == 0 ? subpixels : 1 + random() % subpixels;
    std::uint32_t depth = random() % 3;  // equal depths are frequent
    for (std::uint32_t rest = all; rest > 0;) {
      Object object;
      object.weight = random() % 2 == 0 ? rest : 1 + random() % rest;
      rest -= object.weight;
      object.token.command = Command::new_object;
      std::tie(object.token.y, object.token.x) = at;
      object.token.triangle = random();
      object.token.z = depth;
      depth += random() % 2;
      for (std::uint32_t& word : object.token.radiance)
        word = (random() & ((1U << Preset::c_radiance_bits) - 1)) >> (random() % 3);
      pixels_[at].push_back(object);
    }
  }

  std::uint32_t random() { return static_cast<std::uint32_t>(engine_()); }

  std::mt19937 engine_;
  std::map<At, std::vector<Object>> pixels_;
};

void expect_equal(const std::vector<Fragment>& got, const std::vector<Fragment>& expected) {
  const auto values = [](const Fragment& f) {
    return std::tuple(int{f.y}, int{f.x}, f.triangle, f.z, int{f.red}, int{f.green}, int{f.blue});
  };
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t i = 0; i < got.size(); ++i)
    ASSERT_EQ(values(got[i]), values(expected[i])) << "fragment " << i;
}

template <class Preset>
void expect_filters(const FilterWeights& weights) {
  for (const int channels : {1, 3})
    for (const std::uint32_t subpixels : {1U, 4U, 16U})
      for (unsigned seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(testing::Message()
                     << channels << " channels, " << subpixels << " subpixels, seed " << seed);
        const RandomFrame<Preset> frame(subpixels, seed);
        const auto expected = frame.filtered(channels, subpixels, weights);
        PixelFilter<Preset> filter(channels, subpixels, c_background, weights);
        expect_equal(frame.strip(filter, 0, c_columns - 1), expected);
        // The same in strips that redraw their neighbour column.
        std::vector<Fragment> all;
        for (const auto& [first, last] : {std::pair(0U, 6U), {6U, 7U}, {7U, 20U}, {20U, 22U}}) {
          const auto strip = frame.strip(filter, first, last);
          all.insert(all.end(), strip.begin(), strip.end());
        }
        std::stable_sort(all.begin(), all.end(),
                         [](const Fragment& a, const Fragment& b) { return a.y < b.y; });
        expect_equal(all, expected);
      }
}

TEST(PixelFilter, IsTheRoundedMeanOfFourPixels) {
  expect_filters<words::Exact>(c_filter_weights);
  expect_filters<words::Published>(c_filter_weights);
}

TEST(PixelFilter, WeightsItsPixels) {
  expect_filters<words::Exact>({9, 3, 3, 1});
  expect_filters<words::Published>({9, 3, 3, 1});
  expect_filters<words::Exact>({0, 5, 2, 1});
  expect_filters<words::Published>({1, 0, 2, 1});
}

template <class Preset>
void expect_passes_on(int channels) {
  const RandomFrame<Preset> frame(1, 7);
  PixelFilter<Preset> filter(channels, 1, c_background, {1, 0, 0, 0});
  expect_equal(frame.strip(filter, 0, c_columns - 1), frame.unfiltered(channels));
}

TEST(PixelFilter, EqualsTheFragmentOutputWithOneSubpixelAndWithoutNeighbours) {
  expect_passes_on<words::Exact>(3);
  expect_passes_on<words::Exact>(1);
  expect_passes_on<words::Published>(3);
}

}  // namespace
}  // namespace halfway::golden

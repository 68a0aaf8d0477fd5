// SPDX-License-Identifier: Apache-2.0
#include "frame/metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace halfway {
namespace {

TEST(Metrics, EqualFramesHaveNoDistance) {
  Frame a({7, 3});
  for (std::size_t i = 0; i < a.rgb.size(); ++i) a.rgb[i] = static_cast<std::uint8_t>(11 * i);
  const auto d = frame_distance(a, a);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->pixels, 21u);
  EXPECT_EQ(d->differing, 0u);
  EXPECT_TRUE(std::isinf(d->psnr_db) && d->psnr_db > 0);
  EXPECT_EQ(d->rms, 0.0);
  EXPECT_EQ(d->max_lsb, 0u);
  EXPECT_EQ(d->percentile99, 0u);
}

TEST(Metrics, DifferencesUpToTwoStepsAreClose) {
  Frame a({2, 1}), b({2, 1});
  b.rgb = {2, 2, 2, 0, 3, 0};
  EXPECT_EQ(frame_distance(a, b)->off, 1u);
}

TEST(Metrics, CountsDifferencesInTheMaskOnly) {
  Frame a({2, 2}), b({2, 2});
  b.rgb = {3, 0, 0, 0, 0, 4, 200, 0, 0, 0, 0, 0};
  const std::vector<std::uint8_t> mask{1, 255, 0, 0};
  const auto d = frame_distance(a, b, mask);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->pixels, 2u);
  EXPECT_EQ(d->differing, 2u);
  EXPECT_EQ(d->off, 2u);
  EXPECT_EQ(d->max_lsb, 4u);
  EXPECT_EQ(d->percentile99, 4u);
  EXPECT_DOUBLE_EQ(d->rms, std::sqrt(25.0 / 6.0));
  EXPECT_DOUBLE_EQ(d->psnr_db, 10.0 * std::log10(255.0 * 255.0 * 6.0 / 25.0));
  const auto swapped = frame_distance(b, a, mask);
  ASSERT_TRUE(swapped);
  EXPECT_EQ(swapped->psnr_db, d->psnr_db);
  EXPECT_EQ(frame_distance(a, b)->max_lsb, 200u);
  const auto none = frame_distance(a, b, std::vector<std::uint8_t>(4));
  ASSERT_TRUE(none);
  EXPECT_EQ(none->pixels, 0u);
  EXPECT_TRUE(std::isinf(none->psnr_db));
}

TEST(Metrics, The99thPercentileIgnoresOneInAHundred) {
  Frame a({100, 1}), b({100, 1});
  b.rgb[0] = b.rgb[100] = b.rgb[299] = 9;  // 3 of 300
  EXPECT_EQ(frame_distance(a, b)->percentile99, 0u);
  b.rgb[200] = 7;  // the fourth
  EXPECT_EQ(frame_distance(a, b)->percentile99, 7u);
}

TEST(Metrics, BlackAgainstWhiteIsZeroDecibel) {
  Frame a({4, 4}), b({4, 4});
  b.rgb.assign(b.rgb.size(), 255);
  EXPECT_EQ(frame_distance(a, b)->psnr_db, 0.0);
}

TEST(Metrics, RefusesFramesAndMasksOfOtherSizes) {
  const Frame a({4, 2}), b({2, 4});
  ASSERT_FALSE(frame_distance(a, b));
  EXPECT_EQ(frame_distance(a, b).error().code, ExitCode::bad_input);
  EXPECT_FALSE(frame_distance(a, a, std::vector<std::uint8_t>(7)));
  EXPECT_FALSE(difference_image(a, b));
  Frame torn({4, 2});
  torn.rgb.pop_back();
  EXPECT_FALSE(frame_distance(a, torn));
}

TEST(Metrics, DifferenceImageShowsOneStep) {
  Frame a({1, 2}), b({1, 2});
  a.rgb = {10, 10, 10, 0, 255, 8};
  b.rgb = {10, 11, 8, 255, 0, 0};
  EXPECT_EQ(difference_image(a, b)->rgb, (std::vector<std::uint8_t>{0, 32, 64, 255, 255, 255}));
}

TEST(Frame, RadianceRoundsToTheNearestStep) {
  EXPECT_EQ(to_byte(0.0), 0);
  EXPECT_EQ(to_byte(-1.0), 0);
  EXPECT_EQ(to_byte(std::nan("")), 0);
  EXPECT_EQ(to_byte(0.499 / 255), 0);
  EXPECT_EQ(to_byte(0.501 / 255), 1);
  EXPECT_EQ(to_byte(254.499 / 255), 254);
  EXPECT_EQ(to_byte(254.501 / 255), 255);
  EXPECT_EQ(to_byte(1e300), 255);
}

}  // namespace
}  // namespace halfway

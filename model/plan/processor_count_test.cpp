// SPDX-License-Identifier: Apache-2.0
#include "plan/processor_count.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace halfway {
namespace {

// A million pixels, 30 frames per second, three objects per pixel, five lights of each kind.
constexpr ShadingLoad c_worked{
    .pixels = 1'000'000, .frames = 30, .objects = 3, .directional = 5, .positional = 5};

TEST(Table5, WorkedExample) {
  const ProcessorCount count = count_processors(ProcessorVersion::two, c_worked);
  EXPECT_EQ(count.pipeline_ns, 1950U);
  EXPECT_EQ(count.per_pipeline, 21U);
  EXPECT_EQ(count.published_due_ns, 33U);
  EXPECT_EQ(count.published_pipelines, 60U);  // 1950 / 33 = 59.09
  EXPECT_EQ(*count.published_pipelines * count.per_pipeline, 1260U);
  // With 33.3 ns per pixel instead of 33 ns fewer pipelines are needed.
  EXPECT_DOUBLE_EQ(count.pipelines_needed, 58.5);
  EXPECT_EQ(count.pipelines, 59U);
  EXPECT_EQ(count.processors(), 1239U);
}

TEST(Table5, FormulasEqualThePapers) {
  constexpr double c_cycle = 50e-9;
  for (const std::uint64_t pixels : {1ULL, 307'200ULL, 1'000'000ULL, 4096ULL * 4096})
    for (const std::uint64_t frames : {1U, 25U, 30U, 60U, 144U})
      for (const std::uint64_t objects : {1U, 3U, 8U})
        for (const std::uint64_t r : {0U, 1U, 5U})
          for (const std::uint64_t p : {0U, 2U, 5U}) {
            const ShadingLoad load{pixels, frames, objects, r, p};
            const auto m = static_cast<double>(pixels), hz = static_cast<double>(frames),
                       o = static_cast<double>(objects);
            const ProcessorCount one = count_processors(ProcessorVersion::one, load),
                                 two = count_processors(ProcessorVersion::two, load);
            EXPECT_EQ(one.pipeline_ns, 7 * objects * 50);
            EXPECT_EQ(two.pipeline_ns, 13 * objects * 50);
            EXPECT_EQ(one.single_ns, (14 * r + 4) * objects * 50);
            EXPECT_EQ(two.single_ns, (14 * r + 26 * p + 6) * objects * 50);
            EXPECT_EQ(one.per_pipeline, 2 * r + 1);
            EXPECT_EQ(two.per_pipeline, 2 * r + 2 * p + 1);
            EXPECT_NEAR(one.pipelines_needed, hz * m * 7 * o * c_cycle, 1e-9 * one.pipelines_needed);
            EXPECT_NEAR(two.pipelines_needed, hz * m * 13 * o * c_cycle, 1e-9 * two.pipelines_needed);
            for (const ProcessorCount& count : {one, two}) {
              EXPECT_GE(static_cast<double>(count.pipelines), count.pipelines_needed);
              EXPECT_LT(static_cast<double>(count.pipelines), count.pipelines_needed + 1);
              EXPECT_EQ(count.processors(), count.pipelines * count.per_pipeline);
              // Truncating the nanoseconds never gives fewer pipelines.
              EXPECT_GE(count.published_pipelines.value_or(count.pipelines), count.pipelines);
            }
          }
}

// An exact number of pipelines must not be rounded up: no rounding of seconds in between.
TEST(Table5, WholeNumbersOfPipelinesStayWhole) {
  for (std::uint64_t n = 1; n <= 1000; ++n) {
    // 20 000 000 pixels per second, of 7 n * 50 ns each.
    const ProcessorCount count = count_processors(
        ProcessorVersion::one, {.pixels = 200'000, .frames = 100, .objects = n, .directional = 1});
    EXPECT_EQ(count.pipelines, 7 * n) << n;
  }
}

TEST(Table5, NothingIsPublishedBelowANanosecond) {
  const ShadingLoad load{.pixels = 4096 * 4096, .frames = 60, .directional = 1};
  const ProcessorCount count = count_processors(ProcessorVersion::two, load);
  EXPECT_FALSE(count.published_due_ns);
  EXPECT_FALSE(count.published_pipelines);
  EXPECT_EQ(count.pipelines, 655U);  // 60 * 4096^2 * 650 ns = 654.3 s
}

}  // namespace
}  // namespace halfway

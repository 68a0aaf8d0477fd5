// SPDX-License-Identifier: Apache-2.0
#include "plan/processor_clocks.hpp"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

namespace halfway {
namespace {

using words::Term;

// tb.table4 checks that these values equal the RTL's.
TEST(Table4, PublishedEqualsThePaper) {
  int printed = 0;
  for (const ProcessorClocks& row : c_processor_clocks) {
    if (!row.paper) continue;
    ++printed;
    EXPECT_EQ(row.published, row.paper) << row.what;
    EXPECT_GE(row.exact, *row.paper) << row.what;
  }
  EXPECT_EQ(printed, 7);
}

TEST(Table4, OneRowPerOperation) {
  std::set<std::tuple<std::optional<Term>, std::optional<LightKind>, bool, bool>> works;
  for (const ProcessorClocks& row : c_processor_clocks) {
    EXPECT_TRUE(works.emplace(row.term, row.light, row.normalize, row.view).second) << row.what;
    EXPECT_EQ(row.light.has_value(), row.term && *row.term != Term::ambient) << row.what;
    EXPECT_EQ(row.published.has_value(), !row.view) << row.what;
  }
  EXPECT_EQ(works.size(), 1 + 4 + 2 * 3U);
}

// No row of a pipeline takes longer. Here the rows are enumerated by another method.
TEST(Table5, NoProcessorOfThePipelineIsSlower) {
  for (const Preset preset : {Preset::exact, Preset::published})
    for (unsigned bits = 0; bits < 64; ++bits) {
      HardwareKey key{.shader = Shader::processors, .preset = preset};
      ProcessorUnits& p = key.processors;
      p.directional = bits & 1, p.positional = bits >> 1 & 1, p.spots = bits >> 2 & 1;
      p.diffuse = (bits & 8) != 0, p.specular = (bits & 16) != 0, p.normalize = (bits & 32) != 0;
      const bool view = preset == Preset::exact && p.specular && p.lights() > 0;
      unsigned most = 0;
      const auto add = [&](Term term, std::optional<LightKind> light, bool normalize, bool with_view) {
        for (const ProcessorClocks& row : c_processor_clocks)
          if (row.term == term && row.light == light && row.normalize == normalize && row.view == with_view)
            most = std::max(most, *row.clocks(preset));
      };
      add(Term::ambient, std::nullopt, p.normalize, view);
      for (const auto& [light, count] : {std::pair{LightKind::directional, p.directional},
                                         {LightKind::positional, p.positional},
                                         {LightKind::spot, p.spots}}) {
        if (count > 0 && p.diffuse) add(Term::diffuse, light, false, false);
        if (count > 0 && p.specular) add(Term::specular, light, false, false);
      }
      EXPECT_EQ(slowest_processor(key).clocks(preset), most) << key.name();
    }
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

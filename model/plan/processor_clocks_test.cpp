// SPDX-License-Identifier: Apache-2.0
#include "plan/processor_clocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "plan/plan.hpp"
#include "plan/processor_count.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/must.hpp"

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

Plan plan_of(const std::string& name, Preset preset) {
  const auto scene = must(load_scene(name, std::filesystem::path(HALFWAY_SOURCE_DIR) / "sim" / "scenes"));
  return must(plan_scene(scene, {.shader = Shader::processors, .preset = preset}));
}

TEST(Table5, TheSlowestProcessorIsOneThatTheSceneHas) {
  const auto slowest = [](const HardwareKey& key) -> std::string { return slowest_processor(key).what; };
  const std::tuple<const char*, const char*, const char*> cases[] = {
      {"matte", "directional diffuse", "ambient, N normalized"},
      {"spheres", "directional specular", "directional specular"},
      {"teapot", "directional specular", "directional specular"},
      {"shadows", "positional specular", "positional specular"},
      {"lights", "positional specular", "positional specular"},
  };
  for (const auto& [scene, published, exact] : cases) {
    EXPECT_EQ(slowest(plan_of(scene, Preset::published).called_for), published) << scene;
    EXPECT_EQ(slowest(plan_of(scene, Preset::exact).called_for), exact) << scene;
    EXPECT_EQ(slowest(plan_of(scene, Preset::published).everything), "spot specular") << scene;
    EXPECT_EQ(slowest(plan_of(scene, Preset::exact).everything), "spot specular") << scene;
  }
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

// The paper's worked example with the clocks measured here.
TEST(Table5, WorkedExampleAsMeasured) {
  HardwareKey key{.shader = Shader::processors, .preset = Preset::published};
  key.processors = {.directional = 5, .positional = 5, .diffuse = true, .specular = true, .normalize = true};
  const ShadingLoad load{.pixels = 1'000'000, .frames = 30, .objects = 3, .directional = 5, .positional = 5};
  const auto count = [&] {
    return count_pipelines(*slowest_processor(key).clocks(key.preset),
                           static_cast<std::uint64_t>(processors_config(key).processors()), load);
  };
  const ProcessorCount paper = count_processors(ProcessorVersion::two, load);
  EXPECT_EQ(count().pipeline_ns, paper.pipeline_ns);
  EXPECT_EQ(count().pipelines, paper.pipelines);
  EXPECT_EQ(count().processors(), paper.processors());
  key.preset = Preset::exact;
  EXPECT_EQ(count().pipeline_ns, 7650U);
  EXPECT_EQ(count().pipelines, 230U);
  EXPECT_EQ(count().processors(), 4830U);
}

}  // namespace
}  // namespace halfway

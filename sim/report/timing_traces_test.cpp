// SPDX-License-Identifier: Apache-2.0
#include "sim/report/timing_traces.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plan/plan.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/engines/ghdl/test/checkout.hpp"
#include "sim/files/test/built_in_scene.hpp"
#include "sim/os/must.hpp"
#include "sim/os/subprocess.hpp"
#include "sim/run/why.hpp"

namespace halfway::report {
namespace {

using ::testing::HasSubstr;

class Timing : public ::testing::TestWithParam<Shader> {};
INSTANTIATE_TEST_SUITE_P(Of, Timing, ::testing::ValuesIn(c_shaders),
                         [](const auto& shader) { return to_string(shader.param); });

TEST_P(Timing, ShowsTheGoldenModelsFragmentsInVerilatorsClocks) {
  for (const char* program : {"ghdl", "gnuplot"})
    ASSERT_FALSE(find_program(program).empty()) << "no " << program << " here";
  const ShaderTiming timing = draw_shader_timing(GetParam(), c_checkout);

  const Scene scene = built_in_scene(c_source_folder / "sim/report/timing.toml");
  WhySettings why;
  why.plan.shader = GetParam();
  why.size = {16, 12};
  why.folders = c_checkout;
  why.setup.quadratic.test = HighlightTest::none;
  const auto plan = plan_scene(scene, why.plan);
  ASSERT_TRUE(plan);
  EXPECT_EQ(timing.key, plan->key.name());
  const std::vector<Fragment> golden =
      must(whole_stream(scene, why.size, plan->key, {.setup = why.setup})).golden;
  ASSERT_GE(golden.size(), 4U);
  why.pixel = {golden[0].x, golden[0].y};
  const auto first = explain_pixel(scene, why);
  const auto clock = first.stories.at(0).stages.back().cycle;
  ASSERT_TRUE(clock);
  std::string words;
  for (unsigned n = 0; n < 4; ++n)
    words += fmt::format("{}clock {}: fragment x {}, y {}, red {}", n == 0 ? "" : "; ", *clock + n,
                         golden[n].x, golden[n].y, golden[n].red);
  EXPECT_EQ(timing.words, words);
  for (const std::string& svg : timing.svgs) {
    for (const char* signal : {"init_valid", "line_step", "span_step", "fragment_red"})
      EXPECT_THAT(svg, HasSubstr(signal));
    // At most as wide as a page.
    int width = 0;
    ASSERT_EQ(std::sscanf(svg.c_str() + svg.find("viewBox"), "viewBox=\"0 0 %d", &width), 1);
    EXPECT_LE(width, 1312);
  }
  // The clock of the first fragment is at a tick or next to one.
  std::string all;
  for (const std::string& svg : timing.svgs) all += svg;
  EXPECT_THAT(all, HasSubstr(fmt::format(">{}<", *clock / 2 * 2)));
}

}  // namespace
}  // namespace halfway::report

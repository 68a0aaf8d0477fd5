// SPDX-License-Identifier: Apache-2.0
// The published rule of fraction bits, b > log2 M, in the RTL: the 20 bits of figure 7 on a triangle of 4096
// lines, for which the rule requires 13. Golden model, GHDL and Verilator must have the same error in colour
// steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "golden/quadratic_shader.hpp"
#include "registry.hpp"
#include "sim/ghdl/ghdl_runner.hpp"
#include "sim/stream_files/init_file.hpp"
#include "sim/stream_files/trace.hpp"
#include "sim/system/file.hpp"
#include "sim/verilator/verilator_simulator.hpp"

namespace halfway {
namespace {

using Shader = golden::QuadraticShader<golden::Published, 1>;

// The key of tb/published, so that both use one build.
const HardwareKey c_key{.preset = Preset::published, .channels = 1};

SimulatorFolders folders() {
  return {HALFWAY_SOURCE_DIR, HALFWAY_CACHE_DIR};
}

std::vector<Fragment> golden_fragments(const bounds::RuleCase& rule) {
  std::vector<Fragment> fragments;
  Shader shader;
  shader.draw(rule.init, [&](const Fragment& f) { fragments.push_back(f); });
  return fragments;
}

// The greatest error of a pixel in colour steps. Every pixel must be within the bound plus rounding.
int worst_pixel(const bounds::RuleCase& rule, const std::vector<Fragment>& fragments) {
  int worst = 0;
  for (const Fragment& f : fragments) {
    const double right = std::clamp(rule.right(f.x, f.y), 0.0, 255.0);
    EXPECT_LE(std::fabs(f.red - right), rule.bound + 0.5) << f.x << ", " << f.y;
    worst = std::max(worst, std::abs(f.red - static_cast<int>(std::lround(right))));
  }
  return worst;
}

TEST(PublishedRule, FailsInTheGoldenModelByFourSteps) {
  const bounds::RuleCase rule = bounds::published_rule_case();
  const std::vector<Fragment> fragments = golden_fragments(rule);
  EXPECT_GE(fragments.size(), 4096U);
  EXPECT_EQ(worst_pixel(rule, fragments), 4);
  EXPECT_NEAR(rule.bound, 4.0, 0.01);
}

TEST(PublishedRule, FailsInGhdlLikewise) {
  const bounds::RuleCase rule = bounds::published_rule_case();
  const auto scratch = TemporaryFolder::make(std::filesystem::path(testing::TempDir()) / "published_rule");
  ASSERT_TRUE(scratch) << scratch.error().message;
  const std::filesystem::path init = scratch->path() / "init.txt", trace = scratch->path() / "trace.txt";
  const auto written = write_init_file(init, c_key.name(), InitStream{Shader::c_init_bits, rule.init});
  ASSERT_TRUE(written) << written.error().message;
  const auto runner = GhdlRunner::open(c_key, folders());
  ASSERT_TRUE(runner) << runner.error().message;
  const auto run = runner->run(init, trace);
  ASSERT_TRUE(run) << run.error().message;
  const auto drawn = read_trace(trace, c_key.name());
  ASSERT_TRUE(drawn) << drawn.error().message;
  EXPECT_EQ(drawn->fragments, golden_fragments(rule));
  EXPECT_EQ(worst_pixel(rule, drawn->fragments), 4);
}

TEST(PublishedRule, FailsInVerilatorLikewise) {
  const bounds::RuleCase rule = bounds::published_rule_case();
  auto simulator = VerilatorSimulator::open(c_key, folders(), {});
  ASSERT_TRUE(simulator) << simulator.error().message;
  std::vector<Fragment> fragments;
  const auto ran = simulator->run(rule.init, fragments, 10'000);
  ASSERT_TRUE(ran) << ran.error().message;
  const auto finished = simulator->finish(fragments, 10'000);
  ASSERT_TRUE(finished) << finished.error().message;
  EXPECT_EQ(fragments, golden_fragments(rule));
  EXPECT_EQ(worst_pixel(rule, fragments), 4);
}

}  // namespace
}  // namespace halfway

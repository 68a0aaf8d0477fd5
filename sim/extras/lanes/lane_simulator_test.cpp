// SPDX-License-Identifier: Apache-2.0
// Shaders in lanes: every fragment equals the golden model's, and so Verilator's, whose frames are compared
// with the golden model by other tests.
#include "sim/extras/lanes/lane_simulator.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/test/is_error.hpp"
#include "golden_run/golden_run.hpp"
#include "plan/plan.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/engines/ghdl/test/checkout.hpp"
#include "sim/files/test/built_in_scene.hpp"
#include "sim/os/must.hpp"
#include "sim/run/simulators_test.hpp"

namespace halfway {
namespace {

constexpr std::size_t c_most = std::size_t{1} << 24;

struct Case {
  const char* scene;
  Shader shader;
  Preset preset;
};

class ShadersInLanes : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    Scene scene = built_in_scene(GetParam().scene);
    const auto plan = must(plan_scene(scene, {.shader = GetParam().shader, .preset = GetParam().preset}));
    key_ = plan.key;
    add(scene, {96, 72});
    // From nearby: large parts of the scene are outside the frame.
    const auto middle = scene.camera.target_world;
    scene.camera.eye_world = middle + 0.4 * (scene.camera.eye_world - middle);
    add(scene, {48, 40});
    golden_ = make_golden_model(key_);
  }

  void add(const Scene& scene, FrameSize size) {
    const FrameStream stream = must(whole_stream(scene, size, key_));
    words_.insert(words_.end(), stream.words.begin(), stream.words.end());
    expected_.insert(expected_.end(), stream.golden.begin(), stream.golden.end());
    words_per_vector_ = stream.vector_words();
  }

  HardwareKey key_;
  std::vector<std::uint32_t> words_;
  std::vector<Fragment> expected_;
  std::size_t words_per_vector_ = 0;
  std::unique_ptr<GoldenModel> golden_;
};

TEST_P(ShadersInLanes, DrawWhatTheGoldenModelDraws) {
  for (const unsigned threads : {1U, 3U}) {
    auto lanes = must(LaneSimulator::open(key_, c_checkout, {.threads = threads, .fast = false}));
    std::vector<Fragment> drawn;
    must(lanes.run(words_, drawn, c_most));
    EXPECT_TRUE(drawn == expected_);
    EXPECT_GE(lanes.lane_cycles(), drawn.size());

    // Part by part, each of whole triangles, in other lanes of the same hardware.
    const auto others = must(lanes.another());
    std::span<const std::uint32_t> ahead = words_;
    std::size_t at = 0, parts = 0;
    const auto take = [&](std::span<const Fragment> fragments) {
      const std::span<const Fragment> own = golden_->draw_next(ahead, fragments.size());
      EXPECT_TRUE(std::equal(fragments.begin(), fragments.end(), own.begin(), own.end()));
      at += fragments.size();
      ++parts;
    };
    ASSERT_TRUE(others->draw(words_, c_most, take));
    EXPECT_EQ(at, expected_.size());
    EXPECT_GT(parts, 8U);
    const auto ignore = [](std::span<const Fragment>) {};
    EXPECT_FALSE(others->draw(words_, expected_.size() - 1, ignore));
    // Interrupted within triangles, which must not appear in a later call.
    EXPECT_FALSE(others->draw(words_, 1, ignore));
    ahead = words_;
    at = 0;
    ASSERT_TRUE(others->draw(words_, c_most, take));
    EXPECT_EQ(at, expected_.size());
    EXPECT_TRUE(is_error(others->draw(std::span(words_).first(words_.size() - 1), c_most, ignore),
                         ExitCode::bad_input));

    // Again, in batches of no unit, one, fewer than lanes, and many, appended to the earlier fragments.
    drawn.clear();
    std::span<const std::uint32_t> rest = words_;
    for (std::size_t triangles = 0; !rest.empty(); ++triangles) {
      std::size_t count = 0;
      for (std::size_t i = 0; i < triangles * triangles && count * words_per_vector_ < rest.size(); ++i)
        count += golden_->group(rest.subspan(count * words_per_vector_));
      must(lanes.run(rest.first(count * words_per_vector_), drawn, c_most));
      rest = rest.subspan(count * words_per_vector_);
    }
    EXPECT_TRUE(drawn == expected_);
  }
}

TEST_P(ShadersInLanes, DrawTheSameWithRandomStalls) {
  for (const std::uint32_t seed : {1U, 7U}) {
    auto lanes =
        must(LaneSimulator::open(key_, c_checkout, {.threads = 2, .stall_seed = seed, .fast = false}));
    std::vector<Fragment> drawn;
    must(lanes.run(words_, drawn, c_most));
    EXPECT_TRUE(drawn == expected_) << "seed " << seed;
    // Half of all fragments wait at least one clock.
    EXPECT_GT(lanes.lane_cycles(), 2 * drawn.size());
  }
}

TEST_P(ShadersInLanes, WaitForWhatIsInFrontOrGoOn) {
  for (const std::size_t most_waiting : {std::size_t{0}, std::size_t{200}, c_most}) {
    for (const unsigned threads : {1U, 2U}) {
      auto lanes = must(LaneSimulator::open(
          key_, c_checkout, {.threads = threads, .most_waiting = most_waiting, .fast = false}));
      // Many times the fragments that a run draws before it outputs them.
      constexpr std::size_t c_turns = 24;
      std::vector<std::uint32_t> words;
      for (std::size_t i = 0; i < c_turns; ++i) words.insert(words.end(), words_.begin(), words_.end());
      std::vector<Fragment> drawn;
      must(lanes.run(words, drawn, c_most));
      ASSERT_EQ(drawn.size(), c_turns * expected_.size());
      for (std::size_t i = 0; i < c_turns; ++i)
        ASSERT_TRUE(std::equal(expected_.begin(), expected_.end(),
                               drawn.begin() + static_cast<std::ptrdiff_t>(i * expected_.size())))
            << "turn " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Quick, ShadersInLanes,
                         testing::Values(Case{"spheres", Shader::quadratic, Preset::exact},
                                         Case{"spheres", Shader::spherical, Preset::exact},
                                         Case{"spheres", Shader::processors, Preset::exact}));
INSTANTIATE_TEST_SUITE_P(Whole, ShadersInLanes,
                         testing::Values(Case{"matte", Shader::quadratic, Preset::published},
                                         Case{"lights", Shader::spherical, Preset::published},
                                         Case{"matte", Shader::processors, Preset::published}));

/// The small RTL of both simulators.
class SmallRtlInLanes : public Simulators {
 protected:
  Result<std::vector<Fragment>> lanes(std::size_t most = 1U << 20, LaneOptions options = {}) {
    options.fast = false;
    auto simulator = LaneSimulator::open(key_, folders_, options);
    if (!simulator) return simulator.error();
    std::vector<Fragment> fragments;
    if (auto run = simulator->run(init_.words, fragments, most); !run) return run.error();
    return fragments;
  }
};

TEST_F(SmallRtlInLanes, DetectHangsFaultsAndSuperfluousFragments) {
  const std::size_t limit = expected_.size() - 1;
  EXPECT_TRUE(is_error(lanes(limit), ExitCode::differs));
  for (const unsigned threads : {1U, 3U})
    EXPECT_EQ(must(lanes(limit + 1, {.threads = threads})), expected_) << threads;
  write_rtl({.fault = "if r.left = 9 then v := r; end if;", .valid = "'0' when r.left = 9 else r.valid"});
  EXPECT_TRUE(is_error(lanes(1U << 20, {.idle_limit = 500}), ExitCode::differs, "hang"));
  for (const char* delay : {"0", "4"}) {
    write_rtl(
        {.alarm = "(r.valid and fragment_ready and r.triangle(3) and not r.triangle(31))", .delay = delay});
    EXPECT_TRUE(is_error(lanes(1U << 20, {.idle_limit = 500}), ExitCode::differs, "fault"));
  }
}

}  // namespace
}  // namespace halfway

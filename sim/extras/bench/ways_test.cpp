// SPDX-License-Identifier: Apache-2.0
// Tests `make bench`: every way to a picture draws the correct picture and detects a wrong one. Times are not
// tested.
#include "sim/extras/bench/ways.hpp"

#include <gmock/gmock.h>

#include "common/test/is_error.hpp"
#include "golden_run/walk_counts.hpp"
#include "sim/engines/ghdl/test/checkout.hpp"
#include "sim/extras/bench/workload.hpp"
#include "sim/files/test/built_in_scene.hpp"
#include "sim/os/must.hpp"
#include "sim/os/test/folder_test.hpp"
#include "sim/run/open_engine.hpp"

namespace halfway {
namespace {

constexpr FrameSize c_size{32, 24};

class WayTest : public FolderTest, public testing::WithParamInterface<Way> {
 protected:
  WayInput input() const {
    return {.scene = &scene_,
            .size = size_,
            .stream = &stream_,
            .folders = c_checkout,
            .scratch = here(),
            .fast = false};
  }

  Scene scene_ = built_in_scene("matte");
  FrameSize size_ = c_size;
  GoldenStream stream_ = golden_stream(scene_, c_size, {.shader = Shader::quadratic});
};

TEST_P(WayTest, DrawsTheRightPictureAndSeesAWrongOne) {
  const Way way = GetParam();
  if (way == Way::mesa) {  // a frame with more inside than outline
    scene_ = built_in_scene("spheres");
    size_ = {160, 120};
  }
  ASSERT_EQ(lacking(way, input().folders), "") << to_string(way);
  const Go go = make_way(way, input());
  EXPECT_GT(go(), 0.0);
  // Change the input. The way still draws the first one, which is now wrong.
  if (way == Way::mesa)
    scene_.materials[0].colour *= 0.5;
  else if (is_compared(way))
    stream_.golden.pop_back();
  else
    stream_.golden.back().red ^= 1;
  if (way == Way::reference || way == Way::golden) return;  // not compared with these
  EXPECT_TRUE(is_error(caught(go), ExitCode::differs));
}

INSTANTIATE_TEST_SUITE_P(Bench, WayTest, testing::ValuesIn(c_ways),
                         [](const auto& test) { return short_name(test.param); });

// Each thread draws frames of its own; every fragment is compared.
TEST(BenchWorkload, WholeFramesAreDrawnOnAllThreads) {
  const Scene scene = built_in_scene("matte");
  const HardwareKey key = plan_scene(scene, {.shader = Shader::quadratic})->key;
  const auto engine = must(open_engine(EngineKind::verilator, key, c_checkout)),
             another = must(engine->another());
  std::vector<WholeFrame> drawings;
  for (const auto& each : {engine, another}) drawings.emplace_back(scene, c_size, key, each);
  EXPECT_GT(frame_rate(drawings, 6), 0.0);
  for (const auto& each : {engine, another}) EXPECT_GT(each->cycles(), 0U);
  const FrameSeconds cost = drawings.front().draw();
  for (const auto part : {&FrameSeconds::setup, &FrameSeconds::golden, &FrameSeconds::rtl,
                          &FrameSeconds::compare, &FrameSeconds::assemble})
    EXPECT_GT(cost.*part, 0.0);
  // The key of other hardware: golden model and set-up differ from the engine.
  const HardwareKey other = plan_scene(built_in_scene("spheres"), {})->key;
  EXPECT_THROW(WholeFrame(scene, c_size, other, engine).draw(), Failure);
}

// With all effects, hardware takes no more clocks.
TEST(BenchWorkload, WalkCountsTellTheHardwaresClocks) {
  for (const auto& [shader, all_effects] : {std::pair(Shader::quadratic, false),
                                            {Shader::quadratic, true},
                                            {Shader::spherical, false},
                                            {Shader::spherical, true},
                                            {Shader::processors, false}}) {
    const GoldenStream stream =
        golden_stream(built_in_scene("matte"), {96, 72}, {.shader = shader, .all_effects = all_effects});
    SCOPED_TRACE(stream.key.name());
    WalkCounter counter(stream.key);
    counter.add(stream.words);
    const WalkCounts walk = counter.counts();
    EXPECT_EQ(walk.pixels, stream.golden.size());
    EXPECT_EQ(walk.lines, walk.spans + walk.empty_lines);
    const auto engine = must(open_engine(EngineKind::verilator, stream.key, c_checkout));
    std::vector<Fragment> drawn;
    must(engine->run(stream.words, drawn, SIZE_MAX));
    must(engine->finish(drawn, SIZE_MAX));
    ASSERT_EQ(drawn, stream.golden);
    const std::uint64_t expected = walk.pixels + walk.lost_to_lines + walk.lost_to_headers;
    EXPECT_GT(walk.lost_to_lines, 0U);
    EXPECT_GT(walk.lost_to_headers, 0U);
    EXPECT_GE(engine->cycles(), expected);
    // Additional clocks: the pipeline's depth once, and the processors' lights.
    EXPECT_LE(engine->cycles(), expected + (shader == Shader::processors ? 60 : 11));
  }
}

TEST(BenchWorkload, SpheresHaveTheTrianglesAskedFor) {
  for (const std::uint64_t n : {1'000, 10'000, 123'456}) {
    EXPECT_LE(sphere_scene(n).triangles.size(), n);
    EXPECT_GT(sphere_scene(n).triangles.size(), n - n / 50);
  }
}

}  // namespace
}  // namespace halfway

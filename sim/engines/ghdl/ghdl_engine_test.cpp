// SPDX-License-Identifier: Apache-2.0
// A stream drawn in parts must give the same fragments as in one run.
#include "sim/engines/ghdl/ghdl_engine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "common/test/is_error.hpp"
#include "golden_run/golden_run.hpp"
#include "plan/plan.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/engines/ghdl/test/checkout.hpp"
#include "sim/files/init_file.hpp"
#include "sim/files/test/built_in_scene.hpp"
#include "sim/os/test/folder_test.hpp"

namespace halfway {
namespace {

using ::testing::SizeIs;

struct Stream {
  HardwareKey key;
  InitStream init;
  std::vector<Fragment> golden;
  Cuts cuts;
};

Stream stream_of(const char* name, Shader shader, FrameSize frame) {
  const auto scene = built_in_scene(name);
  const auto plan = must(plan_scene(scene, {.shader = shader}));
  FrameStream stream = must(whole_stream(scene, frame, plan.key));
  Cuts cuts(plan.key);
  cuts.add(stream.words);
  return {plan.key, {stream.init_bits, std::move(stream.words)}, std::move(stream.golden), std::move(cuts)};
}

// The numbers of the vectors that start a triangle.
std::vector<std::uint64_t> triangles_of(const Stream& s) {
  const auto golden = make_golden_model(s.key);
  std::vector<std::uint64_t> firsts;
  for (std::uint64_t at = 0; at < s.init.size();
       at += golden->group(std::span(s.init.words).subspan(at * s.init.words_per_vector())))
    firsts.push_back(at);
  return firsts;
}

TEST(GhdlParts, BeginAtTrianglesAndBecomeShorter) {
  for (const Shader shader : {Shader::quadratic, Shader::spherical}) {
    const Stream s = stream_of("spheres", shader, {320, 240});
    const std::vector<std::uint64_t> triangles = triangles_of(s), parts = s.cuts.parts();
    ASSERT_THAT(parts, SizeIs(::testing::AllOf(::testing::Ge(8U), ::testing::Le(24U))));
    EXPECT_EQ(parts.front(), 0U);
    EXPECT_TRUE(std::ranges::includes(triangles, parts));
    // The first part has no more than an eighth of the pixels, and a margin for the last triangle.
    const auto first = std::span(s.init.words).first(parts[1] * s.init.words_per_vector());
    EXPECT_LE(make_golden_model(s.key)->draw(first).size(),
              std::max<std::size_t>(3'500, s.golden.size() / 6));
  }
}

// Also where triangles depend on those before.
TEST(GhdlParts, AreOneWhereThereIsLittleToDraw) {
  EXPECT_THAT(stream_of("spheres", Shader::quadratic, {64, 48}).cuts.parts(), SizeIs(1));
  EXPECT_THAT(stream_of("spheres", Shader::processors, {160, 120}).cuts.parts(), SizeIs(1));
}

using GhdlRuns = FolderTest;

TEST_F(GhdlRuns, InPartsDrawWhatOneRunDraws) {
  const auto init = at("init"), trace = at("trace");
  for (const Shader shader : {Shader::quadratic, Shader::spherical}) {
    const Stream s = stream_of("spheres", shader, {64, 48});
    const auto runner = must(GhdlRunner::open(s.key, c_checkout));
    ASSERT_TRUE(write_init_file(init, s.key.name(), s.init));
    const std::vector<std::uint64_t> triangles = triangles_of(s);
    const auto one = must(runner.run(init, trace));
    // The second part ends where the third starts. The last part is a single triangle.
    const std::uint64_t parts[] = {0, triangles[1], triangles[triangles.size() / 2], triangles.back()};
    std::vector<Fragment> drawn;
    const auto take = [&](std::span<const Fragment> part) {
      drawn.insert(drawn.end(), part.begin(), part.end());
    };
    for (const unsigned threads : {1U, 3U}) {
      drawn.clear();
      const auto cycles = run_in_parts(runner, s.key, init, parts, {}, threads, take);
      EXPECT_GE(cycles, one.cycles);
      EXPECT_LE(cycles, one.cycles + 3 * 16);
      EXPECT_EQ(drawn, s.golden);
    }
    drawn.clear();
    const auto limited =
        caught([&] { run_in_parts(runner, s.key, init, parts, {.max_fragments = 10}, 2, take); });
    EXPECT_TRUE(is_error(limited, ExitCode::differs, "of 4, from init vector "));
    EXPECT_TRUE(drawn.empty());
  }
}

// Several frames, one of them without a vector.
TEST(GhdlEngine, DrawsInDrainAlone) {
  const Stream s = stream_of("spheres", Shader::quadratic, {64, 48});
  auto engine = must(GhdlEngine::open(s.key, c_checkout, 1, {}));
  EXPECT_FALSE(engine.cycles());
  std::uint64_t cycles = 0;
  for (int frame = 1; frame <= 2; ++frame) {
    std::vector<Fragment> drawn;
    const std::size_t half = triangles_of(s)[40] * s.init.words_per_vector();
    ASSERT_TRUE(engine.run(std::span(s.init.words).first(half), drawn, s.golden.size()));
    ASSERT_TRUE(engine.run(std::span(s.init.words).subspan(half), drawn, s.golden.size()));
    EXPECT_TRUE(drawn.empty());
    const Status ended = engine.finish(drawn, s.golden.size());
    ASSERT_TRUE(ended) << ended.error().message;
    EXPECT_EQ(drawn, s.golden);
    if (frame == 1) cycles = engine.cycles().value();
    EXPECT_EQ(engine.cycles(), frame * cycles);
    ASSERT_TRUE(engine.finish(drawn, s.golden.size()));
    EXPECT_EQ(drawn, s.golden);
  }
  std::vector<Fragment> drawn;
  ASSERT_TRUE(engine.run(s.init.words, drawn, 10));
  EXPECT_TRUE(is_error(engine.finish(drawn, 10), ExitCode::differs));
  EXPECT_TRUE(drawn.empty());
}

}  // namespace
}  // namespace halfway

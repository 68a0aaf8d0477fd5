// SPDX-License-Identifier: Apache-2.0
// Tests `make bench`: every way to a picture draws the correct picture and detects a wrong one. Times are not
// tested.
#include "sim/bench/ways.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>

#include "common/test/is_error.hpp"
#include "sim/bench/workload.hpp"
#include "sim/bench/yardstick.hpp"
#include "sim/run/open_engine.hpp"
#include "sim/scene_files/load_scene.hpp"
#include "sim/system/file.hpp"
#include "sim/system/must.hpp"
#include "sim/system/test/source_folder.hpp"

namespace halfway {
namespace {

constexpr FrameSize c_size{32, 24};

class WayTest : public testing::TestWithParam<Way> {
 protected:
  WayTest() {
    scene_ = *load_scene("matte", c_source_folder / "sim/scenes");
    batches_ = *make_batches(scene_, c_size, {.shader = Shader::quadratic});
    scratch_ = std::filesystem::path(testing::TempDir()) / ("halfway-ways-" + std::to_string(::getpid()));
    EXPECT_TRUE(make_folders(scratch_));
  }
  ~WayTest() override { std::filesystem::remove_all(scratch_); }

  WayInput input() const {
    return {.scene = &scene_,
            .size = size_,
            .batches = &batches_,
            .folders = {c_source_folder, c_source_folder / "build/cache"},
            .scratch = scratch_,
            .fast = false};
  }

  Scene scene_;
  FrameSize size_ = c_size;
  InitBatches batches_;
  std::filesystem::path scratch_;
};

TEST_P(WayTest, DrawsTheRightPictureAndSeesAWrongOne) {
  const Way way = GetParam();
  if (way == Way::mesa) {  // a frame with more inside than outline
    scene_ = *load_scene("spheres", c_source_folder / "sim/scenes");
    size_ = {160, 120};
  }
  const std::string lacks = lacking(way, input().folders);
  // GHDL's other back end is downloaded, not installed, so it is missing on a machine without network.
  if (way == Way::ghdl_mcode && !lacks.empty()) GTEST_SKIP() << to_string(way) << ": not here: " << lacks;
  ASSERT_EQ(lacks, "") << to_string(way);
  const auto go = must(make_way(way, input()));
  const auto seconds = must(go());
  EXPECT_GT(seconds, 0.0);
  // Change the input. The way still draws the first one, which is now wrong.
  if (way == Way::mesa)
    scene_.materials[0].colour *= 0.5;
  else if (is_compared(way))
    batches_.golden.pop_back();
  else
    batches_.golden.back().red ^= 1;
  if (way == Way::reference || way == Way::golden) return;  // not compared with these
  EXPECT_TRUE(is_error(go(), ExitCode::differs));
}

INSTANTIATE_TEST_SUITE_P(Bench, WayTest, testing::ValuesIn(c_ways),
                         [](const auto& test) { return short_name(test.param); });

TEST(BenchWorkload, AFrameIsDrawnWholeAndComparedInEveryField) {
  const SimulatorFolders folders{c_source_folder, c_source_folder / "build/cache"};
  const Scene scene = *load_scene("matte", c_source_folder / "sim/scenes");
  const auto batches = make_batches(scene, c_size, {.shader = Shader::quadratic});
  ASSERT_TRUE(batches);
  const auto engine = must(open_engine(EngineKind::verilator, batches->key, folders));
  const auto cost = must(draw_frame([&] { return scene; }, c_size, batches->key, engine, *batches));
  EXPECT_EQ(cost.mismatches, 0U);
  EXPECT_EQ(cost.fragments, batches->golden.size());
  EXPECT_EQ(cost.vectors, batches->vectors());
  EXPECT_EQ(cost.triangles, scene.triangles.size());
  EXPECT_GT(cost.setup, 0.0);
  EXPECT_GT(cost.rtl, 0.0);
  EXPECT_GT(cost.best_pace, 0.0);
  EXPECT_GE(cost.pace, cost.best_pace);
  EXPECT_GT(cost.memory_bytes, 7U * c_size.width * c_size.height);

  // Hardware for three channels: other vectors.
  const auto other = make_batches(*load_scene("spheres", c_source_folder / "sim/scenes"), c_size, {});
  ASSERT_TRUE(other);
  EXPECT_FALSE(draw_frame([&] { return scene; }, c_size, other->key, engine, *batches));
}

// Each thread draws frames of its own; every frame is compared.
TEST(BenchWorkload, FramesAreDrawnOnAllThreads) {
  const SimulatorFolders folders{c_source_folder, c_source_folder / "build/cache"};
  const Scene scene = *load_scene("matte", c_source_folder / "sim/scenes");
  const HardwareKey key = plan_scene(scene, {.shader = Shader::quadratic})->key;
  const auto engine = must(open_engine(EngineKind::verilator, key, folders));
  const auto another = engine->another();
  ASSERT_TRUE(another);
  const std::vector<std::shared_ptr<Engine>> engines = {engine, *another};
  const auto rate = must(frame_rate(scene, c_size, key, engines, 6));
  EXPECT_GT(rate, 0.0);
  // Both engines have drawn: the clocks of both have advanced.
  for (const std::shared_ptr<Engine>& each : engines) EXPECT_GT(each->cycles(), 0U);
  // The key of other hardware: golden model and set-up differ from the engines.
  const HardwareKey other = plan_scene(*load_scene("spheres", c_source_folder / "sim/scenes"), {})->key;
  EXPECT_FALSE(frame_rate(scene, c_size, other, engines, 2));
}

TEST(BenchWorkload, WalkCountsTellTheHardwaresClocks) {
  const SimulatorFolders folders{c_source_folder, c_source_folder / "build/cache"};
  for (const Shader shader : c_shaders) {
    Scene scene = *load_scene("matte", c_source_folder / "sim/scenes");
    const auto batches = make_batches(scene, {96, 72}, {.shader = shader});
    ASSERT_TRUE(batches);
    const WalkCounts walk = count_walk(*batches);
    EXPECT_EQ(walk.pixels, batches->golden.size());
    EXPECT_EQ(walk.lines, walk.spans + walk.empty_lines);
    const auto engine = must(open_engine(EngineKind::verilator, batches->key, folders));
    std::vector<Fragment> drawn;
    ASSERT_TRUE(engine->run(batches->words, drawn, SIZE_MAX));
    ASSERT_TRUE(engine->finish(drawn, SIZE_MAX));
    ASSERT_EQ(drawn, batches->golden);
    const std::uint64_t expected = walk.pixels + walk.lost_to_lines + walk.lost_to_headers;
    EXPECT_GT(walk.lost_to_lines, 0U);
    EXPECT_GT(walk.lost_to_headers, 0U);
    EXPECT_GE(engine->cycles(), expected);
    // Additional clocks: the pipeline's depth once, and the processors' lights.
    EXPECT_LE(engine->cycles(), expected + (shader == Shader::processors ? 40 : 11)) << to_string(shader);
  }
}

TEST(BenchWorkload, SpheresHaveTheTrianglesAskedFor) {
  for (const std::uint64_t n : {1'000, 10'000, 123'456}) {
    EXPECT_LE(sphere_scene(n).triangles.size(), n);
    EXPECT_GT(sphere_scene(n).triangles.size(), n - n / 50);
    EXPECT_LE(many_spheres(n).triangles.size(), n);
    EXPECT_GT(many_spheres(n).triangles.size(), n - n / 20);
  }
}

// The compiler must not omit any addition, for any processor.
TEST(BenchYardstick, SumsAllThatItSays) {
  for (const std::uint32_t rounds : {0U, 1U, 1000U}) {
    std::uint32_t sums[8];
    for (std::uint32_t i = 0; i < 8; ++i) sums[i] = rounds + i;
    for (std::uint32_t round = 0; round < rounds; ++round) {
      for (const int i : {0, 2, 4, 6}) sums[i] += sums[i + 1];
      for (const int i : {1, 3, 5, 7}) sums[i] += sums[(i + 1) % 8];
    }
    std::uint32_t all = 0;
    for (const std::uint32_t sum : sums) all ^= sum;
    EXPECT_EQ(sum_in_registers(rounds), all) << rounds;
  }
}

TEST(BenchWorkload, LinesAreFitted) {
  const double n[] = {1, 10, 100, 1000};
  const double straight[] = {7, 25, 205, 2005};
  std::vector<Terms> rows;
  for (const double i : n) rows.push_back({1.0, i});
  const Fit line = fit(rows, straight);
  EXPECT_NEAR(line.factors[0], 5.0, 1e-9);
  EXPECT_NEAR(line.factors[1], 2.0, 1e-12);
  EXPECT_LT(line.largest_deviation, 1e-9);
  const double bent[] = {7, 25, 205, 4010};
  EXPECT_GT(fit(rows, bent).largest_deviation, 0.1);
  // A third term bends the line. With its column the fit is exact; with a dependent column it is empty.
  const double rooted[] = {5 + 2 + 30 * 1, 5 + 20 + 30 * 3, 5 + 200 + 30 * 10, 5 + 2000 + 30 * 32};
  EXPECT_GT(fit(rows, rooted).largest_deviation, 0.1);
  const double roots[] = {1, 3, 10, 32};
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].push_back(roots[i]);
  EXPECT_NEAR(fit(rows, rooted).factors[2], 30.0, 1e-9);
  EXPECT_LT(fit(rows, rooted).largest_deviation, 1e-9);
  for (Terms& row : rows) row[2] = 3.0 * row[1];
  EXPECT_TRUE(fit(rows, rooted).factors.empty());
}

}  // namespace
}  // namespace halfway

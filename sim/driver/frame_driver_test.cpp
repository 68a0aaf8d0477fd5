// SPDX-License-Identifier: Apache-2.0
// The stream is setup's prologue and units, independent of how they are drawn: by one golden model that has
// all of it, or by several that have the prologue and a share of the units.
#include "sim/driver/frame_driver.hpp"

#include <gtest/gtest.h>

#include <array>

#include "common/test/is_error.hpp"
#include "golden_run/golden_run.hpp"
#include "plan/plan.hpp"
#include "scene/test/sides_apart.hpp"
#include "shading/test/random_solids.hpp"
#include "sim/driver/test/golden_engine.hpp"
#include "sim/files/test/built_in_scene.hpp"
#include "sim/os/must.hpp"
#include "sim/os/threads.hpp"

namespace halfway {
namespace {

constexpr FrameSize c_stream_frame{160, 120};

HardwareKey key_of(const Scene& scene, Shader shader) {
  return must(plan_scene(scene, {.shader = shader})).key;
}

TEST(FrameDriver, IsPrologueAndUnitsForAnyNumberOfThreads) {
  for (const char* name : {"shadows", "lights"})
    for (const Shader shader : c_shaders) {
      const auto scene = built_in_scene(name);
      const HardwareKey key = key_of(scene, shader);
      const auto setup = make_setup(scene, c_stream_frame, key, {});
      SCOPED_TRACE(key.name());
      EXPECT_EQ(setup->units_are_strips(), key.processors.shadows);
      std::vector<std::uint32_t> words;
      SetupCounts counts;
      setup->append_prologue(words, counts);
      EXPECT_EQ(!words.empty(), shader == Shader::processors);
      setup->append_all(words, counts);
      const auto golden = make_golden_model(key);
      std::vector<Fragment> fragments;
      golden->draw(words, fragments);
      ASSERT_GT(fragments.size(), 2'000U);

      for (const unsigned threads : {1U, 3U, 16U}) {
        Batch all;
        FrameDriver driver(scene, c_stream_frame, key, {}, {.workers = on_threads(threads)});
        must(driver.draw([&](const Batch& batch) -> Status {
          EXPECT_GT(batch.done, all.done);
          all.done = batch.done;
          all.init_words.insert(all.init_words.end(), batch.init_words.begin(), batch.init_words.end());
          all.golden.insert(all.golden.end(), batch.golden.begin(), batch.golden.end());
          return Ok{};
        }));
        EXPECT_EQ(all.done, 1.0);
        EXPECT_EQ(all.init_words, words) << threads;
        EXPECT_EQ(all.golden, fragments) << threads;
        EXPECT_EQ(driver.words(), words.size());
        EXPECT_EQ(driver.fragments(), fragments.size());
        EXPECT_EQ(driver.counts().vectors, counts.vectors);
        EXPECT_EQ(driver.counts().shadows, counts.shadows);
        EXPECT_EQ(driver.counts().projection.visible, counts.projection.visible);
      }
      const FrameStream without = must(whole_stream(
          scene, c_stream_frame, key, {.golden = GoldenDraws::nothing, .workers = on_threads(2)}));
      EXPECT_EQ(without.words, words);
      EXPECT_TRUE(without.golden.empty());
    }
}

// Wherever the golden model draws, each engine gets the whole stream and is compared with all of it.
TEST(FrameDriver, ComparesEachEngineWhereverTheGoldenModelDraws) {
  const auto scene = built_in_scene("spheres");
  for (const Shader shader : c_shaders)
    for (const GoldenDraws golden : {GoldenDraws::batches, GoldenDraws::beside, GoldenDraws::nothing})
      for (const unsigned threads : {1U, 3U}) {
        const HardwareKey key = key_of(scene, shader);
        const auto right = std::make_shared<GoldenEngine>(key), wrong = std::make_shared<GoldenEngine>(key);
        wrong->change = [&](std::vector<Fragment>& own) {
          const std::size_t first = wrong->fragments.size() - own.size();
          if (first <= 700 && 700 < first + own.size()) own[700 - first].red ^= 1;
        };
        std::array<std::uint64_t, 2> drawn{};
        FrameDriver driver(scene, c_stream_frame, key, {right, wrong},
                           {.golden = golden,
                            .golden_picture = golden == GoldenDraws::batches,
                            .workers = on_threads(threads),
                            .on_drawn = [&](std::size_t engine, std::span<const Fragment> part) {
                              drawn[engine] += part.size();
                            }});
        must(driver.draw());
        const SimulatorRun first = driver.frame(0).result(), second = driver.frame(1).result();
        EXPECT_TRUE(first.equal()) << first.description;
        EXPECT_GT(first.fragments, 700U);
        EXPECT_EQ(second.fragments, first.fragments);
        EXPECT_EQ(drawn, (std::array{first.fragments, first.fragments}));
        EXPECT_EQ(second.mismatches, golden == GoldenDraws::nothing ? 0U : 1U);
        EXPECT_EQ(bool(driver.equal()), golden == GoldenDraws::nothing);
        if (golden != GoldenDraws::batches) continue;
        EXPECT_EQ(second.first.at(0).index, 700U);
        EXPECT_EQ(driver.golden_frame().frame().rgb, driver.frame(0).assembler().frame().rgb);
      }
}

// An error of the caller or of an engine ends the frame; the next frame starts afresh.
TEST(FrameDriver, EndsAtTheFirstErrorAndStartsAgain) {
  const auto scene = built_in_scene("spheres");
  const HardwareKey key = key_of(scene, Shader::quadratic);
  for (const unsigned threads : {1U, 3U}) {
    FrameDriver driver(scene, {640, 480}, key, {}, {.workers = on_threads(threads)});
    int batches = 0;
    const Status ended = driver.draw([&](const Batch&) -> Status {
      ++batches;
      return bad_input("stop");
    });
    EXPECT_TRUE(is_error(ended, "stop"));
    EXPECT_EQ(batches, 1);
    must(driver.draw());
    const FrameStream whole = must(whole_stream(scene, {640, 480}, key));
    EXPECT_EQ(driver.words(), whole.words.size());
    EXPECT_EQ(driver.fragments(), whole.golden.size());
  }
}

// Many small triangles make large batches. After them, at most one large triangle per thread exceeds the
// limit of a batch.
TEST(FrameDriver, LargeTrianglesAfterSmallOnesEndTheirBatch) {
  constexpr FrameSize c_size{400, 400};
  constexpr int c_layers = 60;
  Scene scene;
  scene.name = "layers";
  scene.materials = {{.name = "paper"}};
  scene.directional = {{.to_light_world = {0.0, 0.0, 1.0}}};
  Mesh mesh;
  mesh.normals = {{0.0, 0.0, 1.0}};
  const auto add = [&](glm::dvec3 at, double side) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(),
                          {at, at + glm::dvec3(side, 0.0, 0.0), at + glm::dvec3(0.0, side, 0.0)});
    mesh.triangles.push_back({.position = {first, first + 1, first + 2}});
  };
  for (int row = 0; row < 30; ++row)
    for (int column = 0; column < 100; ++column) add({-0.9 + 0.018 * column, -0.9 + 0.018 * row, 1.0}, 0.004);
  for (int i = 0; i < c_layers; ++i) add({-3.0, -3.0, -0.001 * i}, 12.0);
  add_mesh(scene, mesh);
  scene.camera = {.eye_world = {0.0, 0.0, 8.0}, .target_world = {}, .vertical_fov_degrees = 24.0};
  for (const Shader shader : {Shader::quadratic, Shader::spherical}) {
    const HardwareKey key = key_of(scene, shader);
    std::vector<std::uint32_t> words;
    SetupCounts counts;
    make_setup(scene, c_size, key, {})->append_all(words, counts);
    for (const unsigned threads : {1U, 4U}) {
      FrameDriver driver(scene, c_size, key, {}, {.workers = on_threads(threads)});
      std::vector<std::uint32_t> streamed;
      std::size_t largest = 0;  // number of fragments of a batch
      must(driver.draw([&](const Batch& batch) -> Status {
        streamed.insert(streamed.end(), batch.init_words.begin(), batch.init_words.end());
        largest = std::max(largest, batch.golden.size());
        return Ok{};
      }));
      EXPECT_TRUE(streamed == words) << threads;
      EXPECT_EQ(driver.counts().vectors, counts.vectors) << threads;
      EXPECT_GT(driver.fragments(), c_layers * c_size.width * c_size.height);
      EXPECT_LT(largest * sizeof(Fragment), threads * (std::size_t{12} << 20)) << threads;
    }
  }
}

// Snapping reverses none of these triangles.
TEST(FrameDriver, EveryShaderDrawsABackAsAFront) {
  const Scene culled = built_in_scene("lights");
  const Scene scene = drawn_from_both_sides(culled);
  const Scene apart = sides_apart(scene);
  for (const Shader shader : c_shaders) {
    const HardwareKey key = key_of(scene, shader);
    SCOPED_TRACE(key.name());
    const std::vector<Fragment> fragments = must(whole_stream(scene, c_stream_frame, key)).golden;
    std::vector<Fragment> wanted = must(whole_stream(apart, c_stream_frame, key)).golden;
    for (Fragment& f : wanted) f.triangle /= 2;
    EXPECT_TRUE(fragments == wanted);
    EXPECT_GT(2 * fragments.size(), 3 * must(whole_stream(culled, c_stream_frame, key)).golden.size());
  }
}

// Sheets one behind another in front of a wall, with the light behind the eye.
Scene sheets(int count) {
  Scene scene;
  scene.name = "sheets";
  scene.shadows = true;
  scene.materials = {{.name = "paper"}};
  for (int i = 0; i <= count; ++i) {
    const bool wall = i == count;
    Mesh sheet = make_box(wall ? glm::dvec3(40.0, 40.0, 0.1) : glm::dvec3(0.5, 0.5, 0.001), 1);
    for (glm::dvec3& p : sheet.positions)
      p += wall ? glm::dvec3(0.0, 0.0, -8.0) : glm::dvec3(1.0, 0.2, -0.003 * i);
    add_mesh(scene, sheet);
  }
  scene.directional = {{.to_light_world = glm::normalize(glm::dvec3(0.02, 0.01, 1.0))}};
  scene.camera = {.eye_world = {-3.0, 0.2, 3.0}, .target_world = {0.0, 0.0, -6.0}};
  return scene;
}

TEST(FrameDriver, TooManyShadowPolygonsAtAPixelAreRefused) {
  for (const int count : {12, 300}) {
    const Scene scene = sheets(count);
    HardwareKey key = key_of(scene, Shader::processors);
    key.processors.objects = 64;
    FrameDriver driver(scene, {80, 60}, key, {}, {.workers = on_threads(2)});
    const Status status = driver.draw();
    if (count == 12) {
      EXPECT_TRUE(status) << status.error().message;
      continue;
    }
    EXPECT_TRUE(is_error(status, ExitCode::bad_input, "and shadow polygons lie on one line"));
    EXPECT_TRUE(is_error(status, ", or leave the shadows out"));
  }
}

// The eye is behind more sheets than a counter can count, so the volumes contain it. The wall is dark.
TEST(FrameDriver, VolumesAroundTheEyeCount) {
  for (const int count : {40, 600}) {
    Scene scene = sheets(count);
    scene.camera = {.eye_world = {0.95, 0.18, -3.0},
                    .target_world = {0.95, 0.18, -8.0},
                    .vertical_fov_degrees = 0.5,
                    .far = 9.0};
    const HardwareKey key = key_of(scene, Shader::processors);
    const FrameStream dark = must(whole_stream(scene, {40, 30}, key));
    scene.shadows = false;
    const FrameStream lit = must(whole_stream(scene, {40, 30}, key_of(scene, Shader::processors)));
    ASSERT_EQ(dark.golden.size(), 1200U) << count;
    ASSERT_EQ(lit.golden.size(), 1200U);
    for (std::size_t i = 0; i < dark.golden.size(); ++i)
      EXPECT_LT(dark.golden[i].red, lit.golden[i].red) << count;
  }
}

}  // namespace
}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// The stream is setup's prologue and units, independent of how they are drawn: by one golden model that has
// all of it, or by several that have the prologue and a share of the units.
#include "sim/run/scene_stream.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "golden_run/golden_run.hpp"
#include "plan/plan.hpp"
#include "setup/check_counts.hpp"
#include "shading/test/random_solids.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

constexpr FrameSize c_stream_frame{160, 120};

HardwareKey key_of(const Scene& scene, Shader shader) {
  return must(plan_scene(scene, {.shader = shader})).key;
}

TEST(SceneStream, IsPrologueAndUnitsForAnyNumberOfThreads) {
  for (const char* name : {"shadows", "lights"})
    for (const Shader shader : c_shaders) {
      const auto scene = must(load_scene(name, std::filesystem::path(HALFWAY_SOURCE_DIR) / "sim" / "scenes"));
      const HardwareKey key = key_of(scene, shader);
      const auto setup = make_setup(scene, c_stream_frame, key, {});
      SCOPED_TRACE(key.name());
      EXPECT_EQ(setup->units_are_lines(), key.processors.shadows);
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
        SceneStream stream(*setup, key, threads);
        for (Batch batch; stream.next(batch); all.done = batch.done) {
          EXPECT_GT(batch.done, all.done);
          all.init_words.insert(all.init_words.end(), batch.init_words.begin(), batch.init_words.end());
          all.golden.insert(all.golden.end(), batch.golden.begin(), batch.golden.end());
        }
        EXPECT_EQ(all.done, 1.0);
        EXPECT_EQ(all.init_words, words) << threads;
        EXPECT_EQ(all.golden, fragments) << threads;
        EXPECT_EQ(stream.counts().vectors, counts.vectors);
        EXPECT_EQ(stream.counts().shadows, counts.shadows);
        EXPECT_EQ(stream.counts().projection.visible, counts.projection.visible);
        EXPECT_TRUE(check_shadow_counts(scene, stream.counts(), stream.fault()));
        EXPECT_TRUE(check_projection(scene, stream.counts()));
      }
      SceneStream without(*setup, key, 2, {.golden = false, .ahead = false});
      std::vector<std::uint32_t> same;
      for (Batch batch; without.next(batch);) {
        same.insert(same.end(), batch.init_words.begin(), batch.init_words.end());
        EXPECT_TRUE(batch.golden.empty());
      }
      EXPECT_EQ(same, words);
    }
}

std::vector<std::uint32_t> words_of(const Setup& setup, SetupCounts& counts) {
  std::vector<std::uint32_t> words;
  setup.append_all(words, counts);
  return words;
}

// The output of a stream, batch by batch.
struct Streamed {
  std::vector<std::uint32_t> words{};
  std::size_t fragments = 0, largest = 0;  ///< of one batch
};
Streamed streamed(SceneStream& stream) {
  Streamed all;
  for (Batch batch; stream.next(batch);) {
    all.words.insert(all.words.end(), batch.init_words.begin(), batch.init_words.end());
    all.fragments += batch.golden.size();
    all.largest = std::max(all.largest, batch.golden.size());
  }
  return all;
}

// Many small triangles make large batches. After them, at most one large triangle per thread exceeds the
// limit of a batch.
TEST(SceneStream, LargeTrianglesAfterSmallOnesEndTheirBatch) {
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
    const auto setup = make_setup(scene, c_size, key, {});
    SetupCounts counts;
    const std::vector<std::uint32_t> words = words_of(*setup, counts);
    for (const unsigned threads : {1U, 4U}) {
      SceneStream stream(*setup, key, threads);
      const Streamed all = streamed(stream);
      EXPECT_TRUE(all.words == words) << threads;
      EXPECT_EQ(stream.counts().vectors, counts.vectors) << threads;
      EXPECT_GT(all.fragments, c_layers * c_size.width * c_size.height);
      EXPECT_LT(all.largest * sizeof(Fragment), threads * (std::size_t{12} << 20)) << threads;
    }
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

TEST(SceneStream, TooManyShadowVolumesAreRefused) {
  for (const int count : {300, 600}) {
    const Scene scene = sheets(count);
    const HardwareKey key = key_of(scene, Shader::processors);
    const auto setup = make_setup(scene, {80, 60}, key, {});
    SceneStream stream(*setup, key, 2);
    for (Batch batch; stream.next(batch);) {
    }
    const Status status = check_shadow_counts(scene, stream.counts(), stream.fault());
    EXPECT_GE(stream.counts().deepest_shadow, static_cast<std::uint64_t>(count));
    if (count == 300) {
      EXPECT_TRUE(status) << status.error().message;
      continue;
    }
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ExitCode::bad_input);
    EXPECT_THAT(status.error().message, ::testing::HasSubstr("count up to 511"));
    EXPECT_TRUE(stream.fault());
  }
}

// The eye is behind all sheets, so the volumes contain it and are counted from the start.
TEST(SceneStream, VolumesAroundTheEyeCount) {
  Scene scene = sheets(40);
  scene.camera = {.eye_world = {0.95, 0.18, -3.0},
                  .target_world = {0.95, 0.18, -8.0},
                  .vertical_fov_degrees = 0.5,
                  .far = 9.0};
  const HardwareKey key = key_of(scene, Shader::processors);
  const auto setup = make_setup(scene, {40, 30}, key, {});
  SceneStream stream(*setup, key, 1);
  for (Batch batch; stream.next(batch);) {
  }
  EXPECT_EQ(stream.counts().deepest_shadow, 40U);
  EXPECT_FALSE(stream.fault());
}

}  // namespace
}  // namespace halfway

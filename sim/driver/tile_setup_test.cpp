// SPDX-License-Identifier: Apache-2.0
// Tiles drawn separately equal the whole frame bit for bit: depth, colour, order of fragments, and the host's
// counts.
#include "sim/driver/tile_setup.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "frame/assemble.hpp"
#include "plan/plan.hpp"
#include "shading/test/random_solids.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/files/test/built_in_scene.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

constexpr FrameSize c_tile_frame{64, 48};

Scene scene_of(const std::string& name) {
  return built_in_scene(name, {.tessellation = 0.25});
}

HardwareKey key_of(const Scene& scene, Shader shader, Preset preset) {
  return must(plan_scene(scene, {.shader = shader, .preset = preset})).key;
}

// The golden model's fragments of a setup's stream, as a tile.
struct Drawn {
  FrameAssembler assembler;
  std::vector<Fragment> inside;
  SetupCounts counts;
  std::size_t vectors = 0;  // number of words

  Drawn(const Scene& scene, const HardwareKey& key, FrameSize frame, const std::optional<Tile>& part = {})
      : assembler(frame, part.value_or(whole_frame(frame)), glm::dvec3(0.25)) {
    const FrameStream stream = must(whole_stream(scene, frame, key, {.tile = part}));
    const Status added = assembler.add(stream.golden);
    EXPECT_TRUE(added) << added.error().message;
    vectors = stream.words.size();
    std::ranges::copy_if(stream.golden, std::back_inserter(inside),
                         [&](const Fragment& f) { return !part || part->holds(f.x, f.y); });
    counts = stream.counts;
  }
};

std::vector<std::uint64_t> numbers(const SetupCounts& c) {
  const ProjectionCounts& p = c.projection;
  return {c.triangles,   c.subdivided,  c.leaves,  c.vectors,    c.records,        c.shaded,
          c.overexposed, c.unresolved,  c.shadows, p.visible,    p.back_facing,    p.left_out,
          p.behind_near, p.cut_by_near, p.outside, p.degenerate, p.unrepresentable};
}

// Returns the number of fragments of the frame.
std::size_t expect_tiles_are_the_frame(const Scene& scene, const HardwareKey& key, FrameSize frame,
                                       FrameSize size) {
  SCOPED_TRACE(scene.name + " by " + key.name() + " in tiles of " + to_string(size));
  const Drawn whole(scene, key, frame);
  EXPECT_EQ(whole.inside.size(), whole.assembler.fragments());
  SetupCounts counts;
  std::size_t inside = 0;
  for (const Tile& tile : tiles_of(frame, size)) {
    const Drawn drawn(scene, key, frame, tile);
    // The same fragments in the same order.
    std::vector<Fragment> wanted;
    std::ranges::copy_if(whole.inside, std::back_inserter(wanted),
                         [&](const Fragment& f) { return tile.holds(f.x, f.y); });
    EXPECT_EQ(drawn.inside, wanted) << tile.x << "," << tile.y;
    EXPECT_EQ(drawn.assembler.fragments_inside(), wanted.size());
    EXPECT_LE(drawn.vectors, whole.vectors);
    // Only strips are included as a whole.
    if (wanted.empty() && key.processors.objects == 0) EXPECT_EQ(drawn.assembler.fragments(), 0U);
    for (std::uint32_t y = 0; y < tile.size.height; ++y)
      for (std::uint32_t x = 0; x < tile.size.width; ++x) {
        const Frame &a = drawn.assembler.frame(), &b = whole.assembler.frame();
        EXPECT_EQ(drawn.assembler.depth(x, y), whole.assembler.depth(tile.x + x, tile.y + y));
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_EQ(a.rgb[a.offset(x, y) + k], b.rgb[b.offset(tile.x + x, tile.y + y) + k]);
      }
    inside += drawn.inside.size();
    counts += drawn.counts;
  }
  EXPECT_EQ(inside, whole.inside.size());
  EXPECT_EQ(numbers(counts), numbers(whole.counts));
  return inside;
}

TEST(TileSetup, TilesTogetherEqualTheFrame) {
  for (const char* name : {"shadows", "spheres", "lights"})
    for (const Shader shader : c_shaders)
      for (const Preset preset : {Preset::exact, Preset::published}) {
        const Scene scene = scene_of(name);
        const auto plan = plan_scene(scene, {.shader = shader, .preset = preset});
        if (!plan) continue;  // no hardware can draw it
        EXPECT_GT(expect_tiles_are_the_frame(scene, plan->key, c_tile_frame, {20, 20}), 500U);
        if (preset == Preset::exact) expect_tiles_are_the_frame(scene, plan->key, c_tile_frame, {17, 100});
      }
}

// Intersecting solids in each other's shadow, from a distance and from the middle: triangles behind the eye,
// clipped by the near plane, larger than the frame.
TEST(TileSetup, TilesTogetherEqualTheFrameOfHardScenes) {
  RandomSolids random(9);
  std::size_t fragments = 0;
  for (int i = 0; i < 8; ++i) {
    Scene scene = random.scene(4);
    scene.name = fmt::format("scene {}", i);
    if (i % 2 == 1) scene.camera.eye_world = random.cube(0.8);
    for (const Shader shader : c_shaders)
      for (const Preset preset : {Preset::exact, Preset::published}) {
        const auto plan = plan_scene(scene, {.shader = shader, .preset = preset});
        if (plan) fragments += expect_tiles_are_the_frame(scene, plan->key, c_tile_frame, {23, 16});
      }
  }
  EXPECT_GT(fragments, 20'000U);
}

// A triangle over four tiles is in each of them. A tile without triangles gets no vectors.
TEST(TileSetup, ATriangleIsInEachTileThatItTouches) {
  Scene scene = scene_of("matte");
  scene.positions_world = {{-0.9, -0.9, 0.0}, {0.9, -0.9, 0.0}, {0.0, 0.9, 0.0}};
  scene.normals_world = {{0.0, 0.0, 1.0}};
  scene.triangles = {{{0, 1, 2}, {0, 0, 0}, 0}};
  scene.camera = {.eye_world = {0.0, 0.0, 4.0}, .target_world = {0.0, 0.0, 0.0}};
  for (const Shader shader : c_shaders) {
    const HardwareKey key = key_of(scene, shader, Preset::exact);
    const Drawn whole(scene, key, c_tile_frame);
    std::size_t middle = 0, empty = 0;
    for (const Tile& tile : tiles_of(c_tile_frame, {16, 16})) {
      const Drawn drawn(scene, key, c_tile_frame, tile);
      if (drawn.inside.empty()) {
        ++empty;
        EXPECT_EQ(drawn.assembler.fragments(), 0U);
        continue;
      }
      ++middle;
      EXPECT_EQ(drawn.assembler.fragments(), whole.assembler.fragments());  // triangles are never cut
    }
    EXPECT_GE(middle, 4U);
    EXPECT_GE(empty, 4U);
  }
}

}  // namespace
}  // namespace halfway

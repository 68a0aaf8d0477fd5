// SPDX-License-Identifier: Apache-2.0
// Strips compared with the coverage of the whole frame; and frames drawn by different numbers of object
// processors compared with each other and with the reference.
#include "setup/object_strips.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "frame/metrics.hpp"
#include "golden_run/test/drawing.hpp"
#include "plan/plan.hpp"
#include "reference/renderer.hpp"
#include "scene/test/random_scenes.hpp"
#include "setup/setup.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/must.hpp"
#include "words/object_limits.hpp"

namespace halfway {
namespace {

constexpr FrameSize c_strip_frame{61, 47};
constexpr int c_strip_bits = 4;

std::vector<StripItem> random_items(RandomScenes& random, int count) {
  std::vector<StripItem> all;
  for (int i = 0; i < count; ++i) {
    StripItem item;
    for (ScreenPoint& p : item) p = {random.whole(-200, 1200), random.whole(-200, 900)};
    if (i % 2 == 0)  // small
      for (std::size_t k = 1; k < 3; ++k)
        item[k] = {item[0].x + random.whole(-50, 50), item[0].y + random.whole(-50, 50)};
    all.push_back(item);
  }
  return all;
}

// How often each subpixel of the frame is covered by walks in the pixels that a strip draws.
using Coverage = std::vector<int>;

void add_covered(Coverage& coverage, const StripItem& item, const Tile& area, std::uint32_t side,
                 const Tile& drawn) {
  const std::size_t pitch = std::size_t{c_strip_frame.width} * side;
  for (const Walk& walk : strip_walks(item, c_strip_bits, area, side))
    for (std::int64_t y = walk.y; y < walk.y + walk.upper_lines + walk.lower_lines; ++y) {
      const Walk line = line_of(walk, y).walk;
      const std::int64_t shift = line.backward ? 1 : 0;
      const auto [left, right] = std::minmax({line.start.pixel + shift, line.upper.pixel + shift});
      const std::int64_t end = std::min(right, std::int64_t{area.size.width} * side);
      for (std::int64_t x = std::max(left, std::int64_t{0}); x < end; ++x) {
        const std::uint32_t column = area.x * side + static_cast<std::uint32_t>(x);
        const std::uint32_t row = area.y * side + static_cast<std::uint32_t>(y);
        if (drawn.holds(column / side, row / side)) ++coverage[row * pitch + column];
      }
    }
}

TEST(ObjectStrips, DrawEveryCoveredPixelOnceAndFitTheProcessors) {
  RandomScenes random(4);
  for (int round = 0; round < 60; ++round) {
    const std::uint32_t side = 1U << round % 3;
    const ObjectChain chain{.processors = static_cast<std::uint32_t>(random.whole(5, 12)),
                            .side = side,
                            .most_columns = static_cast<std::uint32_t>(random.whole(5, 70)),
                            .most_lines = static_cast<std::uint32_t>(random.whole(5, 60))};
    const std::vector<StripItem> objects = random_items(random, random.whole(1, 30));
    const std::vector<StripItem> shadows = random_items(random, random.whole(0, 8));
    const ObjectStrips cut = cut_strips(objects, shadows, c_strip_bits, c_strip_frame, chain);
    const std::size_t subpixels = Frame::pixels(c_strip_frame) * side * side;
    Coverage expected(subpixels), got(subpixels), shadowed(subpixels), got_shadowed(subpixels);
    std::vector<int> drawn(Frame::pixels(c_strip_frame)), needed(Frame::pixels(c_strip_frame));
    for (const StripItem& shadow : shadows)
      add_covered(shadowed, shadow, whole_frame(c_strip_frame), side, whole_frame(c_strip_frame));
    for (const StripItem& item : objects) {
      Coverage own(subpixels);
      add_covered(own, item, whole_frame(c_strip_frame), side, whole_frame(c_strip_frame));
      // The pixels that have the item in their support.
      for (std::size_t i = 0; i < subpixels; ++i) {
        expected[i] += own[i];
        if (own[i] == 0) continue;
        const std::size_t y = i / (c_strip_frame.width * side) / side,
                          x = i % (c_strip_frame.width * side) / side;
        const std::size_t reach = chain.filtered() ? 1 : 0;
        for (std::size_t v = y; v <= std::min<std::size_t>(y + reach, c_strip_frame.height - 1); ++v)
          for (std::size_t u = x; u <= std::min<std::size_t>(x + reach, c_strip_frame.width - 1); ++u)
            needed[v * c_strip_frame.width + u] = 1;
      }
    }
    std::uint32_t most = 0;
    for (const ObjectStrip& strip : cut.strips) {
      const Tile& area = strip.area;
      EXPECT_LE(area.size.width, chain.most_columns);
      EXPECT_LE(area.size.height, chain.most_lines);
      // The first column and line are neighbours, unless they are the frame's.
      const std::uint32_t left = chain.filtered() && area.x > 0 ? 1 : 0,
                          top = chain.filtered() && area.y > 0 ? 1 : 0;
      const Tile pixels{area.x + left, area.y + top, {area.size.width - left, area.size.height - top}};
      for (std::uint32_t y = 0; y < pixels.size.height; ++y)
        for (std::uint32_t x = 0; x < pixels.size.width; ++x)
          ++drawn[(pixels.y + y) * c_strip_frame.width + pixels.x + x];
      std::vector<std::uint32_t> lines(area.size.height);
      const auto add = [&](Coverage& coverage, const StripItem& item) {
        add_covered(coverage, item, area, side, pixels);
        for (const Walk& walk : strip_walks(item, c_strip_bits, area, side))
          for (std::int64_t y = pixel_lines(walk, side).begin; y < pixel_lines(walk, side).end; ++y)
            most = std::max(most, ++lines[static_cast<std::size_t>(y)]);
      };
      for (const std::uint32_t object : strip.objects) add(got, objects[object]);
      for (const std::uint32_t shadow : strip.shadows) add(got_shadowed, shadows[shadow]);
    }
    ASSERT_EQ(got, expected) << "round " << round;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      ASSERT_LE(drawn[i], 1) << "pixel " << i;
      ASSERT_GE(drawn[i], needed[i]) << "pixel " << i;
    }
    for (std::size_t i = 0; i < subpixels; ++i) {
      const std::size_t y = i / (c_strip_frame.width * side) / side,
                        x = i % (c_strip_frame.width * side) / side;
      if (drawn[y * c_strip_frame.width + x] != 0) {
        ASSERT_EQ(got_shadowed[i], shadowed[i]) << "subpixel " << i;
      }
    }
    EXPECT_EQ(cut.processors, most);
  }
}

TEST(ObjectStrips, NothingGivesNoStrip) {
  EXPECT_TRUE(cut_strips({}, {}, c_strip_bits, c_strip_frame, {.processors = 1}).strips.empty());
  const StripItem outside{{{-400, 5}, {-300, 5}, {-300, 90}}}, shadow{{{40, 5}, {300, 5}, {300, 90}}};
  EXPECT_TRUE(
      cut_strips({&outside, 1}, {&shadow, 1}, c_strip_bits, c_strip_frame, {.processors = 1}).strips.empty());
}

// Objects at the top and at the bottom: the lines between are not scanned.
TEST(ObjectStrips, LinesWithoutAnItemAreLeftOut) {
  const std::array<StripItem, 2> items = {
      {{{{32, 32}, {80, 32}, {32, 80}}}, {{{32, 640}, {80, 640}, {32, 720}}}}};
  const ObjectStrips plain = cut_strips(items, {}, c_strip_bits, c_strip_frame, {.processors = 1});
  ASSERT_EQ(plain.strips.size(), 2U);
  EXPECT_EQ(plain.strips[0].area, (Tile{2, 2, {4, 2}}));
  EXPECT_EQ(plain.strips[1].area, (Tile{2, 40, {4, 4}}));
  const ObjectStrips filtered =
      cut_strips(items, {}, c_strip_bits, c_strip_frame, {.processors = 1, .side = 2});
  EXPECT_EQ(filtered.strips[0].area, (Tile{1, 1, {6, 5}}));
}

// The set-up asks for the walks in the whole frame, which may be wider than a strip.
TEST(ObjectStrips, WalksReachBothSidesOfTheWidestFrame) {
  const Tile widest = whole_frame({4096, 8});
  for (const std::int32_t x : {0, 2048 * 16, 4095 * 16}) {
    const StripItem item{{{x, 0}, {x + 16, 0}, {x, 128}}};
    for (const std::uint32_t side : {1U, 2U, 4U})
      EXPECT_FALSE(strip_walks(item, c_strip_bits, widest, side).empty()) << x << ", side " << side;
  }
}

HardwareKey chain_key(const Scene& scene, Preset preset, unsigned objects, unsigned subpixels = 1,
                      bool all_effects = false) {
  return must(plan_scene(scene, {.shader = Shader::processors,
                                 .preset = preset,
                                 .all_effects = all_effects,
                                 .objects = objects,
                                 .subpixels = subpixels}))
      .key;
}
Scene builtin_scene(const char* name) {
  return must(load_scene(name, std::filesystem::path(HALFWAY_SOURCE_DIR) / "sim" / "scenes"));
}

std::vector<Fragment> sorted(std::vector<Fragment> fragments) {
  std::ranges::sort(fragments, {}, [](const Fragment& f) { return std::pair(f.y, f.x); });
  return fragments;
}

TEST(ObjectStrips, FramesDoNotDependOnTheNumberOfProcessors) {
  const auto compare = [](const char* name, Preset preset, unsigned subpixels, FrameSize frame,
                          std::initializer_list<unsigned> numbers) {
    const Scene scene = builtin_scene(name);
    const Drawn wide = draw(scene, frame, chain_key(scene, preset, 256, subpixels));
    ASSERT_FALSE(wide.fault);
    ASSERT_GT(wide.fragments.size(), 500U);
    for (const unsigned objects : numbers) {
      const Drawn narrow = draw(scene, frame, chain_key(scene, preset, objects, subpixels));
      ASSERT_LE(narrow.counts.objects, objects) << name;
      EXPECT_GE(narrow.counts.vectors, wide.counts.vectors);
      const std::vector<Fragment> expected = sorted(wide.fragments), got = sorted(narrow.fragments);
      ASSERT_EQ(got.size(), expected.size());
      for (std::size_t i = 0; i < got.size(); ++i)
        ASSERT_TRUE(got[i] == expected[i])
            << name << ", " << to_string(preset) << ", " << subpixels << " subpixels, " << objects
            << " processors, pixel " << got[i].x << ',' << got[i].y << ": triangle " << got[i].triangle
            << " z " << got[i].z << " red " << int{got[i].red} << ", with more processors "
            << expected[i].triangle << " z " << expected[i].z << " red " << int{expected[i].red};
    }
  };
  for (const Preset preset : {Preset::exact, Preset::published})
    for (const unsigned subpixels : {1U, 4U, 16U})
      for (const char* name : {"spheres", "matte"}) compare(name, preset, subpixels, c_strip_frame, {24, 40});
  // Changes of published planes are rounded so much that a wide strip shows it.
  compare("spheres", Preset::published, 1, {640, 480}, {1, 4});
}

// Adds all triangles again, in another colour and sheared so little that the surfaces are within a few steps
// of depth of each other and cross.
void add_crossing(Scene& scene) {
  const auto points = static_cast<std::uint32_t>(scene.positions_world.size());
  const auto material = static_cast<std::uint32_t>(scene.materials.size());
  scene.materials.push_back(scene.materials[0]);
  scene.materials.back().colour = {0.1, 0.9, 0.2};
  for (std::uint32_t i = 0; i < points; ++i) {
    const glm::dvec3 p = scene.positions_world[i];
    scene.positions_world.push_back({p.x, p.y, p.z + 1e-6 * p.x});
  }
  for (std::size_t i = 0, count = scene.triangles.size(); i < count; ++i) {
    SceneTriangle triangle = scene.triangles[i];
    for (std::uint32_t& position : triangle.position) position += points;
    triangle.material = material;
    scene.triangles.push_back(triangle);
  }
}

// The rasterizer's frame and that of object processors with one subpixel. Depths are rounded differently, so
// another triangle may be in front where the two nearest depths are within two steps. Tables of preset
// published are not interpolated: a vector that is one step off may have the next entry, and another colour.
TEST(ObjectStrips, FramesAreThoseOfTheRasterizer) {
  constexpr FrameSize c_size{640, 480};
  std::size_t covered = 0, one_step = 0, close = 0, close_more = 0;
  for (const Preset preset : {Preset::exact, Preset::published}) {
    std::size_t more = 0;
    for (const char* name : {"spheres", "teapot", "matte", "lights", "highlights", "shadows", "crossing"}) {
      const bool crossing = std::string_view(name) == "crossing";
      Scene scene = builtin_scene(crossing ? "spheres" : name);
      if (crossing) add_crossing(scene);
      scene.shadows = false;
      const Drawn walked = draw(scene, c_size, chain_key(scene, preset, 0)),
                  chained = draw(scene, c_size, chain_key(scene, preset, 64));
      ASSERT_FALSE(chained.fault);
      FrameAssembler rasterizer(c_size, scene.background), chain(c_size, scene.background);
      ASSERT_TRUE(rasterizer.add(walked.fragments) && chain.add(chained.fragments));
      EXPECT_EQ(chain.fragments(), chain.covered_pixels()) << name;
      ASSERT_TRUE(chain.mask() == rasterizer.mask()) << name;
      covered += chain.covered_pixels();
      std::vector<std::vector<std::uint32_t>> depths(Frame::pixels(c_size));
      for (const Fragment& f : walked.fragments) depths[f.y * c_size.width + f.x].push_back(f.z);
      for (std::size_t i = 0; i < depths.size(); ++i) {
        int steps = 0;
        for (std::size_t c = 3 * i; c < 3 * i + 3; ++c)
          steps = std::max(steps, std::abs(rasterizer.frame().rgb[c] - chain.frame().rgb[c]));
        std::ranges::sort(depths[i]);
        if (depths[i].size() > 1 && depths[i][1] - depths[i][0] <= 2) {
          ++close;
          close_more += steps > 1;
          continue;
        }
        one_step += steps == 1;
        more += steps > 1;
        ASSERT_LE(steps, preset == Preset::exact ? 1 : 8) << name << ", pixel " << i;
      }
    }
    EXPECT_LE(more, preset == Preset::exact ? 0U : 10U);
    fmt::print("{}: {} pixels more than one step apart\n", to_string(preset), more);
  }
  EXPECT_GT(close_more, 0U);
  EXPECT_LE(close_more, 10U);
  fmt::print(
      "{} of {} pixels one step apart; {} with depths within two steps, of these {} more than one step\n",
      one_step, covered, close, close_more);
}

TEST(ObjectStrips, AllEffectsDrawTheSame) {
  for (const unsigned subpixels : {1U, 16U})
    for (const Preset preset : {Preset::exact, Preset::published}) {
      const Scene scene = builtin_scene("matte");
      const HardwareKey lean = chain_key(scene, preset, 24, subpixels),
                        all = chain_key(scene, preset, 24, subpixels, true);
      EXPECT_NE(lean.name(), all.name());
      EXPECT_EQ(draw(scene, c_strip_frame, lean).fragments, draw(scene, c_strip_frame, all).fragments);
    }
}

TEST(ObjectStrips, FilteredFramesAreCloseToTheReference) {
  Scene scene = builtin_scene("matte");
  scene.background = {0.2, 0.4, 0.6};
  for (const unsigned subpixels : {4U, 16U}) {
    const HardwareKey key = chain_key(scene, Preset::exact, 64, subpixels);
    EXPECT_EQ(key.channels, 3U);  // of the background
    const Drawn drawn = draw(scene, {160, 120}, key);
    ASSERT_FALSE(drawn.fault);
    const Frame frame = frame_of(scene, {160, 120}, drawn.fragments);
    const std::vector<ScreenTriangle> triangles = Projector(scene, {160, 120}, {}).project_all();
    const ReferenceImage reference =
        render_filtered(scene, triangles, {.frame = {160, 120}}, words::c_filter_weights);
    const FrameDistance distance = *frame_distance(frame, reference.frame, reference.mask);
    EXPECT_GT(distance.psnr_db, subpixels == 16 ? 40.0 : 30.0) << subpixels;
  }
}

TEST(ObjectStrips, TooFewProcessorsAreRefused) {
  const Scene scene = builtin_scene("teapot");
  const HardwareKey key = chain_key(scene, Preset::exact, 2);
  const auto setup = make_setup(scene, c_strip_frame, key, {});
  std::vector<std::uint32_t> words;
  SetupCounts counts;
  setup->append_prologue(words, counts);
  const Status refused = check_pixels(scene, key, counts, false);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ExitCode::bad_input);
  EXPECT_THAT(refused.error().message,
              testing::HasSubstr(
                  fmt::format("{} pieces of triangles lie on one line of one column", counts.objects)));
  HardwareKey enough = key;
  enough.processors.objects = static_cast<unsigned>(counts.objects);
  EXPECT_TRUE(check_pixels(scene, enough, counts, false));
}

}  // namespace
}  // namespace halfway

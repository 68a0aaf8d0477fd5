// SPDX-License-Identifier: Apache-2.0
// From scenes to fragments of the golden model: channels, splits, small triangles, planes. tb/specification
// compares coverage, depth and colours with exact numbers and with the illumination model.
#include "setup/quadratic_setup.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "golden_run/test/drawing.hpp"
#include "scene/builtin_meshes.hpp"
#include "scene/test/random_scenes.hpp"
#include "setup/test/pixels.hpp"
#include "shading/shade.hpp"
#include "words/quadratic_layout.hpp"

namespace halfway {
namespace {

Scene lit_scene() {
  Scene scene;
  scene.materials.push_back({.name = "m", .colour = {0.8, 0.5, 0.2}, .exponent = 60.0});
  scene.directional.push_back({glm::normalize(glm::dvec3(-0.4, 0.5, 1.0)), {1.0, 0.9, 0.7}});
  scene.positional.push_back({{2.0, 1.0, 3.0}, {0.2, 0.3, 0.5}});
  return scene;
}

/// Vertices moved along the sphere. With `bump` they also move off the sphere: a closed mesh of any shape.
Scene sphere_scene(unsigned seed, double jitter, double bump) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Scene scene = lit_scene();
  Mesh mesh = make_uv_sphere(12, 8, 1.0);
  for (glm::dvec3& p : mesh.positions)
    p = glm::normalize(p + jitter * glm::dvec3(unit(random), unit(random), unit(random))) *
        (1.0 + bump * unit(random));
  add_mesh(scene, mesh);
  scene.camera.eye_world = 3.5 * glm::normalize(glm::dvec3(unit(random), unit(random), unit(random) + 2.0));
  scene.camera.target_world = {0.9 * unit(random), 0.9 * unit(random), 0.0};  // off the middle of the frame
  return scene;
}

Scene teapot_scene(std::uint32_t divisions = 3) {
  Scene scene = lit_scene();
  add_mesh(scene, make_teapot(divisions));
  scene.camera.eye_world = {1.6, 5.0, 9.4};
  scene.camera.target_world = {0.2, 1.4, 0.0};
  return scene;
}

HardwareKey quadratic_key(Preset preset = Preset::exact, int channels = 3, int degree = 2) {
  return {.preset = preset, .channels = static_cast<unsigned>(channels), .degree = degree};
}

Drawn draw_quadratic(const Scene& scene, FrameSize frame, const QuadraticSetupOptions& options,
                     const HardwareKey& key = quadratic_key()) {
  return draw(scene, frame, key, {.quadratic = options});
}

/// The triangles of the scene that are one piece on the screen, by their number.
std::map<std::uint32_t, ScreenTriangle> whole_triangles(const Scene& scene, FrameSize frame) {
  std::map<std::uint32_t, ScreenTriangle> whole;
  std::set<std::uint32_t> cut;
  for (const ScreenTriangle& t : projected(scene, frame))
    if (!whole.emplace(t.source, t).second) cut.insert(t.source);
  for (const std::uint32_t source : cut) whole.erase(source);
  return whole;
}

/// The radiance at a point of a triangle, in colour steps.
glm::dvec3 steps_at(const Scene& scene, const ScreenTriangle& t, glm::dvec3 barycentric) {
  const SurfacePoint p = surface_point(t, barycentric);
  return 255.0 * radiance(scene, scene.materials[t.material], p.position_world, p.normal_world);
}
glm::dvec3 steps_at(const Scene& scene, const ScreenTriangle& t, const Fragment& f) {
  return steps_at(scene, t, barycentric_at_centre(t, c_subpixel_bits, f.x, f.y));
}
glm::dvec3 colour_of(const Fragment& f) {
  return {f.red, f.green, f.blue};
}

// The vectors of degree 1 as vectors of degree 2 whose second differences are zero, and what they draw.
template <class Formats>
Drawn draw_as_quadratics(const Drawn& planes, HardwareKey key) {
  using OfPlane = words::QuadraticLayout<Formats, 1>;
  using OfQuadratic = words::QuadraticLayout<Formats, 2>;
  key.degree = 2;
  const std::size_t to_words = (make_golden_model(key)->init_bits() + 31) / 32;
  Drawn drawn;
  for (std::size_t i = 0; i < planes.words.size(); i += planes.vector_words) {
    const auto from = std::span(planes.words).subspan(i, planes.vector_words);
    drawn.words.resize(drawn.words.size() + to_words);
    const auto to = std::span(drawn.words).last(to_words);
    const auto copy = [&](int bits, int from_low, int to_low) {
      for (int bit = 0; bit < bits; ++bit) {
        const words::Field field{"", bit, 1, false, 0};
        words::set_bits(to, field, words::get_bits(from, field, from_low), to_low);
      }
    };
    copy(Formats::c_init_header_bits, 0, 0);
    for (int c = 0; c < static_cast<int>(key.channels); ++c)
      copy(OfPlane::c_channel_bits, OfPlane::channel_low(c), OfQuadratic::channel_low(c));
  }
  draw_words(key, drawn);
  return drawn;
}

constexpr QuadraticSetupOptions c_whole = {.test = HighlightTest::none};
// The threshold is so small that nearly every triangle is split, some down to the last level.
constexpr QuadraticSetupOptions c_split = {.test = HighlightTest::conservative, .threshold = 0.05};
constexpr QuadraticSetupOptions c_split_some = {
    .test = HighlightTest::conservative, .threshold = 1.0, .max_level = 2};

TEST(QuadraticSetup, OneChannelEqualsEachOfThreeInAGreyScene) {
  Scene scene = sphere_scene(3, 0.1, 0.0);
  scene.materials[0].colour = glm::dvec3(0.7);
  scene.directional[0].intensity = glm::dvec3(0.9);
  scene.positional[0].intensity = glm::dvec3(0.3);
  for (const Preset preset : {Preset::exact, Preset::published}) {
    const Drawn one = draw_quadratic(scene, {160, 120}, c_split_some, quadratic_key(preset, 1)),
                three = draw_quadratic(scene, {160, 120}, c_split_some, quadratic_key(preset, 3));
    ASSERT_GT(one.fragments.size(), 1000u);
    EXPECT_TRUE(one.fragments == three.fragments);
    EXPECT_EQ(one.counts.leaves, three.counts.leaves);
    for (const Fragment& f : three.fragments) ASSERT_EQ(colour_of(f), glm::dvec3(f.red));
  }
}

// Unlimited light: samples are clamped, so that no control point leaves the format.
TEST(QuadraticSetup, OverexposureIsClampedAndCounted) {
  Scene scene = sphere_scene(1, 0.0, 0.0);
  const FrameSize frame{160, 120};
  EXPECT_EQ(draw_quadratic(scene, frame, c_whole).counts.overexposed, 0u);
  scene.directional[0].intensity = glm::dvec3(1e9);
  scene.ambient = glm::dvec3(100.0);
  const Drawn drawn = draw_quadratic(scene, frame, c_whole);
  EXPECT_GT(drawn.counts.overexposed, 100u);
  ASSERT_GT(drawn.fragments.size(), 1000u);
  for (const Fragment& f : drawn.fragments) ASSERT_EQ(colour_of(f), glm::dvec3(255.0));
}

TEST(QuadraticSetup, CountsAreCorrect) {
  const Scene scene = sphere_scene(5, 0.0, 0.0);
  const FrameSize frame{160, 120};
  const SetupCounts whole = draw_quadratic(scene, frame, c_whole).counts,
                    split = draw_quadratic(scene, frame, c_split).counts;
  EXPECT_EQ(whole.subdivided, 0u);
  EXPECT_EQ(whole.unresolved, 0u);
  EXPECT_EQ(whole.leaves, whole.shaded / 6);
  EXPECT_GT(split.subdivided, 0u);
  EXPECT_EQ(whole.triangles, split.triangles);
  EXPECT_GT(split.leaves, 2 * whole.leaves);
  SetupCounts sum = whole;
  sum += split;
  EXPECT_EQ(sum.leaves, whole.leaves + split.leaves);
  EXPECT_EQ(sum.shaded, whole.shaded + split.shaded);
  // The level limit is respected, and the counts report what stays unresolved.
  QuadraticSetupOptions shallow = c_split;
  shallow.max_level = 1;
  const SetupCounts once = draw_quadratic(scene, frame, shallow).counts;
  EXPECT_GT(once.unresolved, 0u);
  EXPECT_LE(once.leaves, 4 * once.triangles);
}

/// Triangles of a fraction of a pixel to 2 pixels at random places, with normals far apart, sharp highlights
/// and every kind of light.
Scene dust_scene(unsigned seed, FrameSize frame) {
  RandomScenes random(seed);
  Scene scene;
  scene.materials.push_back(random.material(false, seed % 2 == 0));
  if (seed % 3 == 0) scene.materials[0].exponent = 500.0;
  random.add_lights(scene, 1 + static_cast<int>(seed % 5), RandomScenes::any, 1.0, false);
  scene.ambient = glm::dvec3(random.within(0.0, 0.5));
  // At the eye's distance of 4, a field of view of 40 degrees and a square frame.
  const double pixel = 2.0 * 4.0 * std::tan(glm::radians(20.0)) / frame.height;
  random.add_triangles(scene, 400, 0.5 * pixel, 1.5);
  return scene;
}

bool all_are_small(const std::vector<ScreenTriangle>& triangles) {
  return std::ranges::all_of(triangles, [](const ScreenTriangle& t) {
    const auto [x0, x1] = std::minmax({t.vertex[0].x, t.vertex[1].x, t.vertex[2].x});
    const auto [y0, y1] = std::minmax({t.vertex[0].y, t.vertex[1].y, t.vertex[2].y});
    return std::max(x1 - x0, y1 - y0) <= c_small_pixels << c_subpixel_bits;
  });
}

// The fragment has the reference's colour, rounded.
bool is_rounded(const Scene& scene, const ScreenTriangle& t, const Fragment& f) {
  const glm::dvec3 off = glm::abs(colour_of(f) - glm::clamp(steps_at(scene, t, f), 0.0, 255.0));
  return std::max({off.x, off.y, off.z}) <= 0.5 + 1e-8;
}

// Six samples may miss all that a small triangle shows. At its pixels' centres nothing is missed: each
// fragment has the reference's colour, rounded, for any threshold and levels.
TEST(QuadraticSetup, SmallTrianglesHaveTheReferencesColours) {
  std::vector<std::pair<Scene, FrameSize>> cases = {{teapot_scene(), {7, 5}}, {teapot_scene(10), {32, 24}}};
  for (unsigned seed = 0; seed < 100; ++seed) {
    const FrameSize frame{32 + seed, 32 + seed};
    cases.emplace_back(dust_scene(seed, frame), frame);
  }
  std::uint64_t fragments = 0, missed = 0;
  for (const auto& [scene, frame] : cases) {
    const std::vector<ScreenTriangle> triangles = projected(scene, frame);
    ASSERT_TRUE(all_are_small(triangles)) << frame.width;
    const auto by_source = whole_triangles(scene, frame);
    const auto wrong = [&, &scene = scene](const Fragment& f) {
      return !is_rounded(scene, by_source.at(f.triangle), f);
    };
    for (const int max_level : {0, 5}) {
      const Drawn drawn = draw_quadratic(scene, frame, {.threshold = 50.0, .max_level = max_level});
      EXPECT_EQ(std::ranges::count_if(drawn.fragments, wrong), 0) << frame.width;
      EXPECT_EQ(drawn.counts.shaded, drawn.fragments.size());
      EXPECT_EQ(drawn.counts.unresolved, 0u);
      fragments += drawn.fragments.size();
    }
    missed += static_cast<std::uint64_t>(
        std::ranges::count_if(draw_quadratic(scene, frame, c_whole).fragments, wrong));
  }
  EXPECT_GT(fragments, 5000u);
  // Six samples get many of them wrong.
  EXPECT_GT(missed, fragments / 10);
}

// Small pieces of larger triangles: with a threshold that splits everything, no fragment of a triangle that
// is small after the last level is off.
TEST(QuadraticSetup, SmallPiecesHaveTheReferencesColours) {
  const Scene scene = sphere_scene(8, 0.1, 0.1);
  const FrameSize frame{96, 72};
  const auto by_source = whole_triangles(scene, frame);
  const Drawn drawn = draw_quadratic(scene, frame, {.threshold = 1e-9});
  EXPECT_GT(drawn.counts.subdivided, 50u);
  EXPECT_EQ(drawn.counts.unresolved, 0u);
  ASSERT_GT(drawn.fragments.size(), 1000u);
  for (const Fragment& f : drawn.fragments) {
    const auto triangle = by_source.find(f.triangle);
    if (triangle == by_source.end()) continue;  // clipped
    ASSERT_TRUE(is_rounded(scene, triangle->second, f)) << f.triangle << ", pixel " << f.x << ',' << f.y;
  }
}

// Where small leaves are drawn by six samples, those above the threshold are counted.
TEST(QuadraticSetup, SmallLeavesOfSixSamplesAreTestedAndCounted) {
  const FrameSize frame{48, 48};
  const Scene scene = dust_scene(3, frame);
  ASSERT_TRUE(all_are_small(projected(scene, frame)));
  const auto unresolved = [&](HighlightTest test, Preset preset) {
    const SetupCounts counts = draw_quadratic(scene, frame, {.test = test}, quadratic_key(preset)).counts;
    EXPECT_EQ(counts.subdivided, 0u);
    EXPECT_LE(counts.unresolved, counts.leaves);
    return counts.unresolved;
  };
  EXPECT_GT(unresolved(HighlightTest::centroid, Preset::exact), 10u);
  EXPECT_GT(unresolved(HighlightTest::centroid, Preset::published), 10u);
  EXPECT_GT(unresolved(HighlightTest::conservative, Preset::published),
            unresolved(HighlightTest::centroid, Preset::published));
  EXPECT_EQ(unresolved(HighlightTest::none, Preset::published), 0u);
}

TEST(QuadraticSetup, PlanesAreQuadraticsWithoutSecondDifferences) {
  const auto expect_same = [](const Scene& scene, const QuadraticSetupOptions& options, Preset preset,
                              int channels) {
    const HardwareKey key = quadratic_key(preset, channels, 1);
    const Drawn planes = draw_quadratic(scene, {160, 120}, options, key);
    EXPECT_GT(planes.fragments.size(), 1000U);
    const Drawn quadratics = preset == Preset::exact ? draw_as_quadratics<words::Exact>(planes, key)
                                                     : draw_as_quadratics<words::Published>(planes, key);
    EXPECT_EQ(quadratics.fragments, planes.fragments);
  };
  for (const Scene& scene : {teapot_scene(), sphere_scene(9, 0.1, 0.15)})
    for (const QuadraticSetupOptions options : {c_whole, c_split_some}) {
      expect_same(scene, options, Preset::exact, 3);
      expect_same(scene, options, Preset::exact, 1);
      expect_same(scene, options, Preset::published, 3);
    }
}

// Each colour is that of the plane through the radiance at the triangle's vertices, rounded.
TEST(QuadraticSetup, PlanesPassThroughTheVertices) {
  const FrameSize frame{160, 120};
  const Scene scene = teapot_scene();
  const Drawn planes = draw_quadratic(scene, frame, c_whole, quadratic_key(Preset::exact, 3, 1));
  EXPECT_EQ(planes.counts.shaded, 3 * planes.counts.leaves);
  ASSERT_GT(planes.fragments.size(), 1000U);
  const auto by_source = whole_triangles(scene, frame);
  for (const Fragment& f : planes.fragments) {
    const ScreenTriangle& t = by_source.at(f.triangle);
    const glm::dvec3 weight = barycentric_at_centre(t, c_subpixel_bits, f.x, f.y);
    glm::dvec3 colour(0.0);
    for (int i = 0; i < 3; ++i)
      colour += weight[i] * glm::clamp(steps_at(scene, t, barycentric_at_vertex(static_cast<std::size_t>(i))),
                                       0.0, c_largest_sample);
    const glm::dvec3 off = glm::abs(colour_of(f) - glm::min(colour, 255.0));
    ASSERT_LE(std::max({off.x, off.y, off.z}), 0.501);
  }
}

/// In colour steps, of triangles that are one piece on the screen.
double largest_error(const Scene& scene, FrameSize frame, const Drawn& drawn) {
  const auto by_source = whole_triangles(scene, frame);
  double largest = 0.0;
  for (const Fragment& f : drawn.fragments) {
    const glm::dvec3 steps = steps_at(scene, by_source.at(f.triangle), f);
    const glm::dvec3 off = glm::abs(colour_of(f) - glm::clamp(steps, 0.0, 255.0));
    largest = std::max({largest, off.x, off.y, off.z});
  }
  return largest;
}

// The test of planes looks at the midpoints too: the quadratic through the same samples would pass it there.
TEST(QuadraticSetup, PlanesAreSplitUntilTheyAreWithinTheThreshold) {
  const FrameSize frame{160, 120};
  const Scene scene = teapot_scene();
  constexpr double c_one_step = 1.0;
  const Drawn planes =
      draw_quadratic(scene, frame, {.test = HighlightTest::conservative, .threshold = c_one_step},
                     quadratic_key(Preset::exact, 3, 1));
  EXPECT_GT(planes.counts.subdivided, 100U);
  EXPECT_EQ(planes.counts.unresolved, 0U);
  const double largest = largest_error(scene, frame, planes);
  // The test is tuned to, and may exceed, twice the threshold (highlight_bound.hpp); 0.5 for rounding.
  EXPECT_LE(largest, 2 * c_one_step + 0.5);
  EXPECT_GT(largest, 0.5);
}

// A flat triangle has its own normal everywhere: its diffuse light is constant.
TEST(QuadraticSetup, AFlatTriangleInDirectionalLightIsNotSplit) {
  Scene scene;
  scene.materials = {{.name = "m", .specular = 0.0}};
  scene.directional.push_back({{0.6, 0.0, 0.8}, glm::dvec3(1.0)});
  scene.positions_world = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  scene.normals_world = {glm::dvec3(0.0)};
  scene.triangles = {{{0, 1, 2}, {0, 0, 0}, 0}};
  for (const HighlightTest test : {HighlightTest::conservative, HighlightTest::proved}) {
    const Drawn drawn = draw_quadratic(scene, {160, 120}, {.test = test, .threshold = 0.5});
    EXPECT_GT(drawn.fragments.size(), 500U);
    EXPECT_EQ(drawn.counts.leaves, 1U);
  }
}

// The normals turn unevenly: between the samples of a piece the diffuse light leaves the quadratic by 4
// steps.
TEST(QuadraticSetup, TheConservativeTestSplitsTrianglesWhoseNormalsNearlyCancel) {
  const FrameSize frame{96, 96};
  Scene scene;
  scene.camera = {.eye_world = {0.0, 0.0, 18.1920772}, .vertical_fov_degrees = 3.50671699};
  scene.materials = {{.name = "m",
                      .colour = {0.182055682, 0.689076162, 0.806460095},
                      .ambient = 0.0,
                      .diffuse = 0.472784285,
                      .specular = 0.0}};
  scene.positional = {{{2.58392484, 3.78771039, 0.529845985}, {0.760841086, 0.712012578, 0.0516666987}}};
  scene.positions_world = {{0.172289477, 0.35274379, 0.025128196},
                           {-0.209638847, 0.331908721, -0.00883330649},
                           {-0.175783218, -0.351015819, -0.0253840576}};
  scene.normals_world = {{0.0412215144, 0.0407555293, 0.998318473},
                         {-0.0412464874, -0.0406292613, -0.998322588},
                         {-0.010949409, -0.0538216765, 0.99849053}};
  scene.triangles = {{{0, 1, 2}, {0, 1, 2}, 0}};
  const QuadraticSetupOptions options{.test = HighlightTest::conservative, .threshold = 0.5};
  const Drawn drawn = draw_quadratic(scene, frame, options);
  EXPECT_GT(drawn.fragments.size(), 500U);
  EXPECT_EQ(drawn.counts.unresolved, 0U);
  EXPECT_LE(largest_error(scene, frame, drawn), options.threshold + 0.5);
}

}  // namespace
}  // namespace halfway

// SPDX-License-Identifier: Apache-2.0
// From scenes to fragments: compares the golden model, with init vectors from the setup, with independently
// computed coverage, plane and quadratic.
#include "setup/quadratic_setup.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "golden/quadratic_shader.hpp"
#include "scene/builtin_meshes.hpp"
#include "setup/test/random_scenes.hpp"
#include "shading/shade.hpp"

namespace halfway {
namespace {

constexpr int c_subpixel_bits = 4;

void add_mesh(Scene& scene, const Mesh& mesh) {
  const auto positions = static_cast<std::uint32_t>(scene.positions_world.size());
  const auto normals = static_cast<std::uint32_t>(scene.normals_world.size());
  scene.positions_world.insert(scene.positions_world.end(), mesh.positions.begin(), mesh.positions.end());
  scene.normals_world.insert(scene.normals_world.end(), mesh.normals.begin(), mesh.normals.end());
  for (SceneTriangle t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) t.position[i] += positions, t.normal[i] += normals;
    t.material = 0;
    scene.triangles.push_back(t);
  }
}

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

struct Drawn {
  std::vector<Fragment> fragments;
  std::vector<std::uint32_t> words;
  std::size_t words_per_vector = 0;
  SetupCounts counts;
};

template <class Preset, int Channels, int Degree = 2>
void draw_words(Drawn& drawn) {
  using Shader = golden::QuadraticShader<Preset, Channels, Degree>;
  ASSERT_EQ(drawn.words_per_vector, Shader::c_init_words);
  Shader shader;
  for (std::size_t i = 0; i < drawn.words.size(); i += drawn.words_per_vector)
    shader.draw(std::span(drawn.words).subspan(i, drawn.words_per_vector),
                [&](const Fragment& f) { drawn.fragments.push_back(f); });
}

Drawn draw(const Scene& scene, FrameSize frame, QuadraticSetupOptions options, Preset preset = Preset::exact,
           unsigned channels = 3) {
  const QuadraticSetup setup(scene, frame, {.preset = preset, .channels = channels}, options);
  Drawn drawn;
  drawn.words_per_vector = (setup.init_bits() + 31) / 32;
  setup.append_all(drawn.words, drawn.counts);
  EXPECT_EQ(drawn.words.size(), drawn.counts.vectors * drawn.words_per_vector);
  if (preset == Preset::exact)
    channels == 3 ? draw_words<golden::Exact, 3>(drawn) : draw_words<golden::Exact, 1>(drawn);
  else
    channels == 3 ? draw_words<golden::Published, 3>(drawn) : draw_words<golden::Published, 1>(drawn);
  return drawn;
}

// Vectors of degree 1, and what the shader of degree 1 draws.
template <class Formats, int Channels>
Drawn draw_planes(const Scene& scene, FrameSize frame, QuadraticSetupOptions options) {
  constexpr Preset c_preset = std::is_same_v<Formats, golden::Exact> ? Preset::exact : Preset::published;
  const HardwareKey key{.preset = c_preset, .channels = Channels, .degree = 1};
  const QuadraticSetup setup(scene, frame, key, options);
  Drawn drawn;
  drawn.words_per_vector = (setup.init_bits() + 31) / 32;
  setup.append_all(drawn.words, drawn.counts);
  draw_words<Formats, Channels, 1>(drawn);
  return drawn;
}

// The vectors of degree 1 as vectors of degree 2 whose second differences are zero, and what they draw.
template <class Formats, int Channels>
Drawn draw_as_quadratics(const Drawn& planes) {
  using Plane = golden::QuadraticLayout<Formats, 1>;
  using Quadratic = golden::QuadraticLayout<Formats, 2>;
  Drawn drawn;
  drawn.words_per_vector = golden::QuadraticShader<Formats, Channels>::c_init_words;
  for (std::size_t i = 0; i < planes.words.size(); i += planes.words_per_vector) {
    const auto from = std::span(planes.words).subspan(i, planes.words_per_vector);
    drawn.words.resize(drawn.words.size() + drawn.words_per_vector);
    const auto to = std::span(drawn.words).last(drawn.words_per_vector);
    const auto copy = [&](int bits, int from_low, int to_low) {
      for (int bit = 0; bit < bits; ++bit) {
        const golden::Field field{"", bit, 1, false, 0};
        golden::set_bits(to, field, golden::get_bits(from, field, from_low), to_low);
      }
    };
    copy(Formats::c_init_header_bits, 0, 0);
    for (int c = 0; c < Channels; ++c)
      copy(Plane::c_channel_bits, Plane::channel_low(c), Quadratic::channel_low(c));
  }
  draw_words<Formats, Channels>(drawn);
  return drawn;
}

std::vector<ScreenTriangle> projected(const Scene& scene, FrameSize frame) {
  return Projector(scene, frame, {.subpixel_bits = c_subpixel_bits}).project_all();
}

using Pixels = std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>>;  // triangle, y, x

Pixels covered(const std::vector<ScreenTriangle>& triangles, FrameSize frame) {
  Pixels pixels;
  for (const ScreenTriangle& t : triangles)
    for_each_span({ScreenPoint{t.vertex[0].x, t.vertex[0].y}, ScreenPoint{t.vertex[1].x, t.vertex[1].y},
                   ScreenPoint{t.vertex[2].x, t.vertex[2].y}},
                  c_subpixel_bits, frame, [&](std::uint32_t y, std::uint32_t begin, std::uint32_t end) {
                    for (std::uint32_t x = begin; x < end; ++x) pixels.emplace_back(t.source, y, x);
                  });
  std::ranges::sort(pixels);
  return pixels;
}

Pixels drawn_pixels(const std::vector<Fragment>& fragments) {
  Pixels pixels;
  for (const Fragment& f : fragments) pixels.emplace_back(f.triangle, f.y, f.x);
  std::ranges::sort(pixels);
  return pixels;
}

constexpr QuadraticSetupOptions c_whole = {.test = HighlightTest::none};
// The threshold is so small that nearly every triangle is split, some down to the last level.
constexpr QuadraticSetupOptions c_split = {.test = HighlightTest::conservative, .threshold = 0.05};
constexpr QuadraticSetupOptions c_split_some = {
    .test = HighlightTest::conservative, .threshold = 1.0, .max_level = 2};
constexpr std::array<FrameSize, 5> c_frames = {{{160, 120}, {37, 91}, {320, 64}, {1, 1}, {500, 400}}};

// Triangles split or not, with split or unsplit neighbours, partly outside the frame: each triangle of the
// scene draws its own pixels exactly once.
TEST(QuadraticSetup, EachTriangleDrawsItsPixelsOnceForEverySplit) {
  std::vector<Scene> scenes = {teapot_scene()};
  for (unsigned seed = 0; seed < 3; ++seed) scenes.push_back(sphere_scene(seed, 0.1, 0.15));
  scenes.push_back(sphere_scene(9, 0.1, 0.15));
  scenes.back().camera.eye_world = {0.3, 0.2, 1.3};  // within the reach of the guard band
  std::uint64_t split = 0, walks = 0;
  for (const Scene& scene : scenes)
    for (const FrameSize frame : c_frames) {
      const Pixels expected = covered(projected(scene, frame), frame);
      for (const QuadraticSetupOptions& options : {c_whole, c_split, c_split_some}) {
        if (options.threshold < 0.1 && frame.width > 400) continue;  // limits the run time
        const Drawn drawn = draw(scene, frame, options);
        ASSERT_TRUE(drawn_pixels(drawn.fragments) == expected)
            << frame.width << 'x' << frame.height << ", " << drawn.counts.leaves << " leaves";
        split += drawn.counts.subdivided;
        walks += drawn.counts.vectors > drawn.counts.triangles;
      }
    }
  EXPECT_GT(split, 1000u);
  EXPECT_GT(walks, 5u);
}

TEST(QuadraticSetup, AClosedConvexMeshIsDrawnWithoutGapsAndOnce) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    const Scene scene = sphere_scene(seed, 0.0, 0.0);
    const FrameSize frame = c_frames[seed % c_frames.size()];
    for (const QuadraticSetupOptions& options : {c_whole, c_split, c_split_some}) {
      std::vector<int> count(std::size_t{frame.width} * frame.height);
      for (const Fragment& f : draw(scene, frame, options).fragments)
        ++count[std::size_t{f.y} * frame.width + f.x];
      for (std::uint32_t y = 0; y < frame.height; ++y) {
        int changes = 0, before = 0;
        for (std::uint32_t x = 0; x < frame.width; ++x) {
          const int here = count[std::size_t{y} * frame.width + x];
          ASSERT_LE(here, 1) << "seed " << seed << " pixel " << x << ',' << y;
          changes += here != before && x > 0;
          before = here;
        }
        ASSERT_LE(changes, 2) << "a gap, seed " << seed << " line " << y;
      }
      EXPECT_GT(20 * std::ranges::count(count, 1), std::ssize(count));
    }
  }
}

// Without splitting: compare the colour with the Lagrange form of the six samples, and the depth with the
// plane, both at the pixel's centre.
TEST(QuadraticSetup, FragmentsAreTheQuadraticThroughTheRadianceAndThePlaneThroughTheDepths) {
  for (Scene scene : {teapot_scene(), sphere_scene(4, 0.1, 0.1)}) {
    scene.directional[0].intensity *= 1.7;  // over-exposes in places
    const FrameSize frame{320, 240};
    std::map<std::uint32_t, ScreenTriangle> by_source;
    for (const ScreenTriangle& t : projected(scene, frame))
      ASSERT_TRUE(by_source.emplace(t.source, t).second) << "clipped: choose another camera";
    const Drawn drawn = draw(scene, frame, c_whole);
    EXPECT_EQ(drawn.counts.subdivided, 0u);
    ASSERT_GT(drawn.fragments.size(), 10000u);
    int white = 0;
    for (const Fragment& f : drawn.fragments) {
      const ScreenTriangle& t = by_source.at(f.triangle);
      const auto sample = [&](glm::dvec3 barycentric) {
        const SurfacePoint p = surface_point(t, barycentric);
        return 255.0 * radiance(scene, scene.materials[0], p.position_world, p.normal_world);
      };
      const glm::dvec3 b = barycentric_at_centre(t, c_subpixel_bits, f.x, f.y);
      const glm::dvec3 colour =
          b.x * (2 * b.x - 1) * sample({1, 0, 0}) + b.y * (2 * b.y - 1) * sample({0, 1, 0}) +
          b.z * (2 * b.z - 1) * sample({0, 0, 1}) + 4 * b.x * b.y * sample({0.5, 0.5, 0}) +
          4 * b.x * b.z * sample({0.5, 0, 0.5}) + 4 * b.y * b.z * sample({0, 0.5, 0.5});
      // Rounding, plus the error of the differences over a triangle of less than 100 pixels.
      const double most = 0.5 + 1e-4;
      ASSERT_NEAR(f.red, std::clamp(colour.x, 0.0, 255.0), most);
      ASSERT_NEAR(f.green, std::clamp(colour.y, 0.0, 255.0), most);
      ASSERT_NEAR(f.blue, std::clamp(colour.z, 0.0, 255.0), most);
      const double z = surface_point(t, b).z * double((1 << 24) - 1);
      ASSERT_NEAR(f.z, z, 0.5 + 0.01);
      white += f.red == 255;
    }
    EXPECT_GT(white, 100);
  }
}

TEST(QuadraticSetup, DepthDoesNotDependOnSplitting) {
  const Scene scene = sphere_scene(2, 0.1, 0.1);
  const FrameSize frame{160, 120};
  const auto depths = [&](const QuadraticSetupOptions& options) {
    std::map<std::tuple<std::uint32_t, int, int>, std::uint32_t> z;
    for (const Fragment& f : draw(scene, frame, options).fragments) z[{f.triangle, f.y, f.x}] = f.z;
    return z;
  };
  const auto whole = depths(c_whole), split = depths(c_split);
  ASSERT_EQ(whole.size(), split.size());
  for (const auto& [pixel, z] : whole) {
    const std::int64_t other = split.at(pixel);
    ASSERT_LE(std::abs(other - z), 1);
  }
}

TEST(QuadraticSetup, OneChannelEqualsEachOfThreeInAGreyScene) {
  for (const Preset preset : {Preset::exact, Preset::published}) {
    Scene scene = sphere_scene(3, 0.1, 0.0);
    scene.materials[0].colour = glm::dvec3(0.7);
    scene.directional[0].intensity = glm::dvec3(0.9);
    scene.positional[0].intensity = glm::dvec3(0.3);
    const FrameSize frame{160, 120};
    const Drawn one = draw(scene, frame, c_split_some, preset, 1),
                three = draw(scene, frame, c_split_some, preset, 3);
    ASSERT_GT(one.fragments.size(), 1000u);
    EXPECT_TRUE(one.fragments == three.fragments);
    EXPECT_EQ(one.counts.leaves, three.counts.leaves);
    for (const Fragment& f : three.fragments) {
      ASSERT_EQ(f.red, f.green);
      ASSERT_EQ(f.red, f.blue);
    }
  }
}

// Unlimited light: samples are clamped, so that no control point leaves the format.
TEST(QuadraticSetup, OverexposureIsClampedAndCounted) {
  Scene scene = sphere_scene(1, 0.0, 0.0);
  const FrameSize frame{160, 120};
  EXPECT_EQ(draw(scene, frame, c_whole).counts.overexposed, 0u);
  scene.directional[0].intensity = glm::dvec3(1e9);
  scene.ambient = glm::dvec3(100.0);
  const Drawn drawn = draw(scene, frame, c_whole);
  EXPECT_GT(drawn.counts.overexposed, 100u);
  ASSERT_GT(drawn.fragments.size(), 1000u);
  for (const Fragment& f : drawn.fragments) {
    ASSERT_EQ(f.red, 255);
    ASSERT_EQ(f.green, 255);
    ASSERT_EQ(f.blue, 255);
  }
}

TEST(QuadraticSetup, CountsAreCorrect) {
  const Scene scene = sphere_scene(5, 0.0, 0.0);
  const FrameSize frame{160, 120};
  const SetupCounts whole = draw(scene, frame, c_whole).counts, split = draw(scene, frame, c_split).counts;
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
  const SetupCounts once = draw(scene, frame, shallow).counts;
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

// The reference's colour of a channel, if it is not within rounding of the middle between two bytes.
bool is_rounded(std::uint32_t colour, double radiance) {
  const double steps = std::clamp(255.0 * radiance, 0.0, 255.0);
  return std::abs(static_cast<double>(colour) - steps) <= 0.5 + 1e-8;
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
    std::map<std::uint32_t, ScreenTriangle> by_source;
    for (const ScreenTriangle& t : triangles) ASSERT_TRUE(by_source.emplace(t.source, t).second);
    const auto wrong = [&, &scene = scene](const Fragment& f) {
      const ScreenTriangle& t = by_source.at(f.triangle);
      const SurfacePoint p = surface_point(t, barycentric_at_centre(t, c_subpixel_bits, f.x, f.y));
      const glm::dvec3 r = radiance(scene, scene.materials[0], p.position_world, p.normal_world);
      return !(is_rounded(f.red, r.x) && is_rounded(f.green, r.y) && is_rounded(f.blue, r.z));
    };
    for (const int max_level : {0, 5}) {
      const Drawn drawn = draw(scene, frame, {.threshold = 50.0, .max_level = max_level});
      EXPECT_EQ(std::ranges::count_if(drawn.fragments, wrong), 0) << frame.width;
      EXPECT_EQ(drawn.counts.shaded, drawn.fragments.size());
      EXPECT_EQ(drawn.counts.unresolved, 0u);
      fragments += drawn.fragments.size();
    }
    missed += static_cast<std::uint64_t>(std::ranges::count_if(draw(scene, frame, c_whole).fragments, wrong));
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
  std::map<std::uint32_t, std::vector<ScreenTriangle>> by_source;
  for (const ScreenTriangle& t : projected(scene, frame)) by_source[t.source].push_back(t);
  const Drawn drawn = draw(scene, frame, {.threshold = 1e-9});
  EXPECT_GT(drawn.counts.subdivided, 50u);
  EXPECT_EQ(drawn.counts.unresolved, 0u);
  ASSERT_GT(drawn.fragments.size(), 1000u);
  for (const Fragment& f : drawn.fragments) {
    const bool right = std::ranges::any_of(by_source.at(f.triangle), [&](const ScreenTriangle& t) {
      const SurfacePoint p = surface_point(t, barycentric_at_centre(t, c_subpixel_bits, f.x, f.y));
      const glm::dvec3 r = radiance(scene, scene.materials[0], p.position_world, p.normal_world);
      return is_rounded(f.red, r.x) && is_rounded(f.green, r.y) && is_rounded(f.blue, r.z);
    });
    ASSERT_TRUE(right) << "triangle " << f.triangle << ", pixel " << f.x << ',' << f.y;
  }
}

// Where small leaves are drawn by six samples, those above the threshold are counted.
TEST(QuadraticSetup, SmallLeavesOfSixSamplesAreTestedAndCounted) {
  const FrameSize frame{48, 48};
  const Scene scene = dust_scene(3, frame);
  ASSERT_TRUE(all_are_small(projected(scene, frame)));
  const auto unresolved = [&](HighlightTest test, Preset preset) {
    const SetupCounts counts = draw(scene, frame, {.test = test}, preset).counts;
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

// The papers' walk: lines and spans include both ends, and the edges have real slopes. It draws every pixel
// inside, none more than one pixel outside, and all in the frame. It repeats pixels along shared edges, as
// published.
TEST(QuadraticSetup, PublishedWalkCoversTheInsideAndStaysCloseToTheEdges) {
  std::vector<Scene> scenes = {teapot_scene(), sphere_scene(6, 0.1, 0.1), sphere_scene(7, 0.1, 0.1)};
  scenes[2].camera.eye_world = {0.3, 0.2, 1.3};
  for (const Scene& scene : scenes)
    for (const FrameSize frame : {FrameSize{160, 120}, FrameSize{37, 91}, FrameSize{500, 400}}) {
      const Drawn drawn = draw(scene, frame, c_whole, Preset::published);
      std::map<std::uint32_t, std::vector<ScreenTriangle>> by_source;
      const Projector projector(scene, frame, {.subpixel_bits = 0, .clip_to_frame = true});
      for (const ScreenTriangle& t : projector.project_all()) by_source[t.source].push_back(t);
      // Twice the area of the pixel with each edge, positive inside; and its distance from that edge.
      const auto least_distance = [](const ScreenTriangle& t, int x, int y) {
        double least = 1e9;
        for (std::size_t i = 0; i < 3; ++i) {
          const ScreenVertex &a = t.vertex[i], &b = t.vertex[(i + 1) % 3];
          const double ex = b.x - a.x, ey = b.y - a.y;
          least = std::min(least, (ex * (y - a.y) - ey * (x - a.x)) / std::hypot(ex, ey));
        }
        return least;
      };
      Pixels pixels = drawn_pixels(drawn.fragments);
      for (const auto& [source, y, x] : pixels) {
        ASSERT_LT(x, frame.width);
        ASSERT_LT(y, frame.height);
        double best = -1e9;
        for (const ScreenTriangle& t : by_source.at(source))
          best = std::max(best, least_distance(t, static_cast<int>(x), static_cast<int>(y)));
        ASSERT_GT(best, -1.0) << "pixel " << x << ',' << y;
      }
      for (const auto& [source, triangles] : by_source)
        for (const ScreenTriangle& t : triangles) {
          const auto [x0, x1] = std::minmax({t.vertex[0].x, t.vertex[1].x, t.vertex[2].x});
          const auto [y0, y1] = std::minmax({t.vertex[0].y, t.vertex[1].y, t.vertex[2].y});
          for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x)
              if (least_distance(t, x, y) > 0) {
                ASSERT_TRUE(std::ranges::binary_search(
                    pixels, std::tuple(source, static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(x))))
                    << "pixel " << x << ',' << y << " of (" << t.vertex[0].x << ',' << t.vertex[0].y << ") ("
                    << t.vertex[1].x << ',' << t.vertex[1].y << ") (" << t.vertex[2].x << ',' << t.vertex[2].y
                    << ')';
              }
        }
    }
}

template <class Formats, int Channels>
void expect_planes_are_quadratics(const Scene& scene, FrameSize frame, QuadraticSetupOptions options) {
  const Drawn planes = draw_planes<Formats, Channels>(scene, frame, options);
  EXPECT_GT(planes.fragments.size(), 1000U);
  const Drawn quadratics = draw_as_quadratics<Formats, Channels>(planes);
  EXPECT_EQ(quadratics.fragments, planes.fragments);
}

TEST(QuadraticSetup, PlanesAreQuadraticsWithoutSecondDifferences) {
  for (const Scene& scene : {teapot_scene(), sphere_scene(9, 0.1, 0.15)})
    for (const QuadraticSetupOptions options : {c_whole, c_split_some}) {
      expect_planes_are_quadratics<golden::Exact, 3>(scene, {160, 120}, options);
      expect_planes_are_quadratics<golden::Exact, 1>(scene, {160, 120}, options);
      expect_planes_are_quadratics<golden::Published, 3>(scene, {160, 120}, options);
    }
}

// Each colour is that of the plane through the radiance at the triangle's vertices, rounded.
TEST(QuadraticSetup, PlanesPassThroughTheVertices) {
  const FrameSize frame{160, 120};
  const Scene scene = teapot_scene();
  const Drawn planes = draw_planes<golden::Exact, 3>(scene, frame, c_whole);
  EXPECT_EQ(planes.counts.shaded, 3 * planes.counts.leaves);
  std::map<std::uint32_t, std::vector<ScreenTriangle>> of_source;
  for (const ScreenTriangle& t : projected(scene, frame)) of_source[t.source].push_back(t);
  std::size_t compared = 0;
  for (const Fragment& f : planes.fragments) {
    const auto& triangles = of_source.at(f.triangle);
    if (triangles.size() != 1) continue;  // clipped
    const ScreenTriangle& t = triangles.front();
    const auto on_screen = [&](double x, double y, std::size_t a, std::size_t b) {
      const double unit = 1 << c_subpixel_bits;
      const double ax = t.vertex[a].x / unit, ay = t.vertex[a].y / unit;
      return (t.vertex[b].x / unit - ax) * (y - ay) - (t.vertex[b].y / unit - ay) * (x - ax);
    };
    const double x = f.x + 0.5, y = f.y + 0.5;
    const glm::dvec3 area(on_screen(x, y, 1, 2), on_screen(x, y, 2, 0), on_screen(x, y, 0, 1));
    glm::dvec3 colour(0.0);
    for (std::size_t i = 0; i < 3; ++i) {
      glm::dvec3 corner(0.0);
      corner[static_cast<int>(i)] = 1.0;
      const SurfacePoint p = surface_point(t, corner);
      const glm::dvec3 sample =
          radiance(scene, scene.materials[t.material], p.position_world, p.normal_world);
      colour += glm::clamp(255.0 * sample, 0.0, c_largest_sample) *
                (area[static_cast<int>(i)] / (area.x + area.y + area.z));
    }
    colour = glm::min(colour, 255.0);
    EXPECT_NEAR(f.red, colour.r, 0.501);
    EXPECT_NEAR(f.green, colour.g, 0.501);
    EXPECT_NEAR(f.blue, colour.b, 0.501);
    ++compared;
  }
  EXPECT_GT(compared, 1000U);
}

// The test of planes looks at the midpoints too: the quadratic through the same samples would pass it there.
TEST(QuadraticSetup, PlanesAreSplitUntilTheyAreWithinTheThreshold) {
  const FrameSize frame{160, 120};
  const Scene scene = teapot_scene();
  constexpr double c_threshold = 1.0;
  const Drawn planes = draw_planes<golden::Exact, 3>(
      scene, frame, {.test = HighlightTest::conservative, .threshold = c_threshold});
  EXPECT_GT(planes.counts.subdivided, 100U);
  EXPECT_EQ(planes.counts.unresolved, 0U);
  std::map<std::uint32_t, std::vector<ScreenTriangle>> of_source;
  for (const ScreenTriangle& t : projected(scene, frame)) of_source[t.source].push_back(t);
  double largest = 0.0;
  for (const Fragment& f : planes.fragments) {
    const auto& triangles = of_source.at(f.triangle);
    if (triangles.size() != 1) continue;  // clipped
    const ScreenTriangle& t = triangles.front();
    const SurfacePoint p = surface_point(t, barycentric_at_centre(t, c_subpixel_bits, f.x, f.y));
    const glm::dvec3 steps = glm::clamp(
        255.0 * radiance(scene, scene.materials[t.material], p.position_world, p.normal_world), 0.0, 255.0);
    const glm::dvec3 error = glm::abs(steps - glm::dvec3(f.red, f.green, f.blue));
    largest = std::max({largest, error.r, error.g, error.b});
  }
  // The test is calibrated to twice the threshold (highlight_bound.hpp); 0.5 for rounding.
  EXPECT_LE(largest, 2 * c_threshold + 0.5);
  EXPECT_GT(largest, 0.5);
}

}  // namespace
}  // namespace halfway

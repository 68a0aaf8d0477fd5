// SPDX-License-Identifier: Apache-2.0
// Where the spherical shader's formulas are 0/0, its angles are nearly half a turn, its words nearly full:
// what exact promises holds there, and how published goes wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iostream>
#include <map>
#include <vector>

#include "golden/multiplier.hpp"
#include "golden/saturating_sum.hpp"
#include "golden/triangle_walker.hpp"
#include "reference/shade.hpp"
#include "run/simulate.hpp"
#include "scene/builtin_meshes.hpp"
#include "setup/random_scenes.hpp"
#include "setup/spherical_drawing.hpp"

namespace halfway {
namespace {

using golden::Exact, golden::Published;

constexpr FrameSize c_frame{161, 121};  // odd: a pixel lies in the very middle

// A triangle across the view of an eye straight above it, lit by nothing yet.
Scene stage(std::array<glm::dvec3, 3> normals = {{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}}) {
  Scene scene;
  scene.name = "stage";
  scene.materials = {{.name = "m", .ambient = 0.0, .diffuse = 0.5, .specular = 0.5, .exponent = 20.0}};
  scene.camera.eye_world = {0.0, 0.0, 4.0};
  scene.positions_world = {{-1.6, -1.3, 0.0}, {1.7, -1.2, 0.0}, {-0.1, 1.4, 0.0}};
  for (const glm::dvec3 n : normals) scene.normals_world.push_back(glm::normalize(n));
  scene.triangles = {{{0, 1, 2}, {0, 1, 2}, 0}};
  return scene;
}

std::vector<ScreenTriangle> projected(const Scene& scene, FrameSize frame) {
  return Projector(scene, frame, {.subpixel_bits = c_exact_subpixel_bits}).project_all();
}
SurfacePoint pixel_point(const ScreenTriangle& t, std::int64_t x, std::int64_t y) {
  return surface_point(
      t, barycentric_screen(t, (2 * x + 1) << c_exact_subpixel_bits, (2 * y + 1) << c_exact_subpixel_bits));
}
// Of a triangle that was clipped.
const ScreenTriangle& piece_at(const std::vector<ScreenTriangle>& pieces, std::int64_t x, std::int64_t y) {
  return *std::ranges::max_element(pieces, {}, [&](const ScreenTriangle& t) {
    const glm::dvec3 b =
        barycentric_screen(t, (2 * x + 1) << c_exact_subpixel_bits, (2 * y + 1) << c_exact_subpixel_bits);
    return std::min({b.x, b.y, b.z});
  });
}
glm::dvec3 surface_at(const Scene& scene, FrameSize frame, std::int64_t x, std::int64_t y) {
  return pixel_point(projected(scene, frame).at(0), x, y).position_world;
}

// Every record's words stay in their formats, on every pixel of its line.
template <class P>
void expect_words_in_range(const Drawn& drawn, const HardwareKey& key) {
  constexpr bool c_exact = std::is_same_v<P, Exact>;
  const golden::SphericalConfig config = golden_config(key);
  const golden::SphericalLayout<P> layout(config);
  const auto model = make_golden_model(key);
  std::span<const std::uint32_t> rest = drawn.words;
  while (!rest.empty()) {
    const std::size_t vectors = model->group(rest);
    golden::TriangleWalker<P> walker;
    walker.line_load(rest);
    const auto expect_factor = [&](std::span<const std::uint32_t> words, const golden::Field& field,
                                   int low) {
      EXPECT_LE(golden::get_bits(words, field, low), (c_exact ? 65535u : 1023u) << P::c_factor_fraction_bits);
    };
    for (int c = 0; c < config.channels; ++c)
      expect_factor(rest, P::ambient_channel_at::ambient, layout.ambient_low(c));
    for (std::size_t line = 1; vectors > 1; ++line) {
      const auto record = rest.subspan(line * drawn.vector_words, drawn.vector_words);
      using Angle = golden::Word<P::c_angle_bits>;
      const std::int64_t steps = std::abs(walker.stop().value() - walker.start().value()) - 1;
      const auto expect_angle = [&](const golden::Field& angle, const golden::Field& slope, int low) {
        if (!c_exact || walker.line_empty()) return;  // published wraps
        const std::int64_t last = Angle::from_bits(golden::get_bits(record, angle, low)).value() +
                                  steps * Angle::from_bits(golden::get_bits(record, slope, low)).value();
        EXPECT_LT(std::abs(last), std::int64_t{1} << (P::c_angle_bits - 1)) << "an angle wraps";
      };
      for (int l = 0; l < config.lights; ++l) {
        if (layout.has_diffuse_part()) {
          using At = typename P::diffuse_header_at;
          expect_angle(At::angle, At::slope, layout.diffuse_low(l));
          for (int c = 0; c < layout.diffuse_channels(); ++c)
            expect_factor(record, P::diffuse_channel_at::factor,
                          layout.diffuse_low(l) + P::c_diffuse_header_bits + c * P::c_diffuse_channel_bits);
        }
        if (config.specular) {
          using At = typename P::specular_header_at;
          expect_angle(At::angle, At::slope, layout.specular_low(l));
          for (int c = 0; c < config.highlight_channels; ++c)
            expect_factor(
                record, P::specular_channel_at::factor,
                layout.specular_low(l) + P::c_specular_header_bits + c * P::c_specular_channel_bits);
        }
      }
      if (walker.line_last()) break;
      walker.line_step();
    }
    rest = rest.subspan(vectors * drawn.vector_words);
  }
}

struct Accuracy {
  std::uint64_t fragments = 0, past = 0;
  double largest = 0.0, promised = 0.0;
  int brightest = 0;
  SetupCounts counts;
};
std::ostream& operator<<(std::ostream& out, const Accuracy& a) {
  return out << a.past << " of " << a.fragments << " fragments past " << a.promised
             << " steps, largest error " << a.largest << ", " << a.counts.leaves << " columns";
}

// The scene by exact, whose every fragment is compared with the radiance; and by slerp along the edges and by
// published, which must draw something of it without a word out of range.
Accuracy check(const Scene& scene, FrameSize frame = c_frame, double threshold = 2.0) {
  const HardwareKey key = spherical_key(scene);
  const Drawn drawn = draw(scene, frame, key, {.threshold = threshold});
  expect_words_in_range<Exact>(drawn, key);
  Accuracy accuracy;
  accuracy.promised = promised_steps(scene, key, threshold);
  accuracy.counts = drawn.counts;
  std::map<std::uint32_t, std::vector<ScreenTriangle>> pieces;
  for (const ScreenTriangle& t : projected(scene, frame)) pieces[t.source].push_back(t);
  for (const Fragment& f : drawn.fragments) {
    const ScreenTriangle& t = piece_at(pieces.at(f.triangle), f.x, f.y);
    const SurfacePoint p = pixel_point(t, f.x, f.y);
    Material material = scene.materials[t.material];
    material.exponent = std::min(material.exponent, c_largest_exponent);
    const glm::dvec3 truth = radiance(scene, material, p.position_world, p.normal_world);
    const glm::dvec3 colour(f.red, f.green, f.blue);
    double error = 0.0;
    for (int c = 0; c < 3; ++c)
      error = std::max(error, std::abs(colour[c] - 255.0 * std::min(truth[c], 1.0)));
    ++accuracy.fragments;
    accuracy.past += error > accuracy.promised;
    accuracy.largest = std::max(accuracy.largest, error);
    accuracy.brightest = std::max(accuracy.brightest, int{f.red});
  }
  EXPECT_GT(accuracy.fragments, 0u);

  const Drawn slerped = draw(scene, frame, key, {.ends = SpanEnds::slerped_along_edges});
  expect_words_in_range<Exact>(slerped, key);
  EXPECT_EQ(slerped.fragments.size(), drawn.fragments.size());

  const HardwareKey published_key = spherical_key(scene, Preset::published);
  const Drawn published = draw(scene, frame, published_key);
  expect_words_in_range<Published>(published, published_key);
  for (const Fragment& f : published.fragments) {
    EXPECT_LT(f.x, frame.width);
    EXPECT_LT(f.y, frame.height);
  }
  return accuracy;
}

// One of each kind of light, to the side.
void add_side_lights(Scene& scene) {
  scene.directional.push_back({glm::normalize(glm::dvec3(0.3, 0.2, 1.0)), glm::dvec3(0.4)});
  scene.positional.push_back({{0.4, -0.3, 2.0}, glm::dvec3(0.4)});
  scene.spots.push_back(
      {{-0.5, 0.3, 2.5}, glm::normalize(glm::dvec3(0.5, -0.2, -2.5)), 0.95, 0.9, glm::dvec3(0.4)});
}

// What `halfway sim` says of a scene, golden model alone.
std::string notes(const Scene& scene, Preset preset = Preset::exact) {
  SimulateSettings settings;
  settings.plan.shader = Shader::spherical;
  settings.plan.preset = preset;
  settings.size = c_frame;
  settings.ghdl = settings.verilator = false;
  settings.out = testing::TempDir();
  const auto summary = simulate(scene, settings);
  EXPECT_TRUE(summary) << summary.error().message;
  std::string all;
  if (summary)
    for (const std::string& note : summary->notes) all += note + '\n';
  return all;
}

TEST(SphericalHardCases, GammaToZero) {
  RandomScenes random(1);
  for (const double apart : {0.0, 1e-17, 1e-16, 1e-15, 1e-14, 1e-12, 1e-9, 1e-6, 1e-3})
    for (const Brdf brdf : {Brdf::blinn, Brdf::phong}) {
      Scene scene = stage();
      scene.materials[0].brdf = brdf;
      for (glm::dvec3& n : scene.normals_world) n = glm::normalize(n + apart * random.cube());
      add_side_lights(scene);
      const Accuracy a = check(scene);
      EXPECT_EQ(a.past, 0u) << "normals " << apart << " apart: " << a;
      EXPECT_GT(a.brightest, 100);
      // A light and an eye that are far away as well: nothing turns at all.
      scene.positional.clear();
      scene.spots.clear();
      scene.camera.eye_world.z = 1e9;
      scene.camera.vertical_fov_degrees = 1e-7;
      const Accuracy far = check(scene);
      EXPECT_EQ(far.past, 0u) << "normals " << apart << " apart: " << far;
    }
}

TEST(SphericalHardCases, GammaToPi) {
  RandomScenes random(2);
  std::uint64_t fragments = 0, past = 0;
  for (const double apart : {0.0, 1e-16, 1e-12, 1e-6, 1e-2}) {
    // Opposed along the lowest edge; all three of them across it.
    for (const auto& normals : {std::array<glm::dvec3, 3>{{{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}}},
                                {{{0, 0, 1}, {0, 0, -1}, {0, 1, 0}}},
                                {{{0, 0.6, 0.8}, {0, -0.6, -0.8}, {0, 0.6, 0.8}}},
                                {{{0, 0, -1}, {0, 0, -1}, {0, 0, 1}}}}) {
      Scene scene = stage(normals);
      for (glm::dvec3& n : scene.normals_world) n = glm::normalize(n + apart * random.cube());
      add_side_lights(scene);
      const Accuracy a = check(scene);
      fragments += a.fragments;
      past += a.past;
    }
  }
  std::cout << past << " of " << fragments << " fragments past the promise\n";
  EXPECT_LE(past, 0u);
}

// L turns half a turn at once where the light lies in the surface.
TEST(SphericalHardCases, GammaVToPi) {
  std::uint64_t fragments = 0, past = 0;
  for (const double height : {0.0, 1e-15, 1e-9, 1e-6, 1e-3, 1e-2})
    for (const double between : {0.5, 0.25, 1e-3, 1e-9}) {
      Scene scene = stage({{{0.1, 0, 1}, {-0.1, 0, 1}, {0, 0.1, 1}}});
      const glm::dvec3 p = surface_at(scene, c_frame, 80, 60), q = surface_at(scene, c_frame, 81, 60);
      scene.positional.push_back({p + between * (q - p) + glm::dvec3(0, 0, height), glm::dvec3(0.8)});
      const Accuracy a = check(scene);
      fragments += a.fragments;
      past += a.past;
      EXPECT_LE(a.past, 0u) << height << ' ' << between << ": " << a;
    }
  std::cout << past << " of " << fragments << " fragments past the promise\n";
}

// N turns in a plane across L: N.L = 0, and L is the axis of its turn.
TEST(SphericalHardCases, AmplitudeZero) {
  Scene scene = stage({{{0, -0.5, 1}, {0, 0, 1}, {0, 0.5, 1}}});
  scene.directional.push_back({{1, 0, 0}, glm::dvec3(1.0)});
  for (const double exponent : {1.0, 2.0, 1000.0}) {
    scene.materials[0].exponent = exponent;
    const Accuracy a = check(scene);
    EXPECT_EQ(a.past, 0u) << a;
    EXPECT_EQ(a.brightest, 0) << "dark: the light grazes the surface";
  }
  // The highlight's amplitude alone: R across V everywhere.
  Scene mirror = stage();
  mirror.materials[0].brdf = Brdf::phong;
  mirror.camera.eye_world.z = 1e9;
  mirror.camera.vertical_fov_degrees = 1e-7;
  mirror.directional.push_back({glm::normalize(glm::dvec3(1, 0, 1)), glm::dvec3(1.0)});
  for (glm::dvec3& n : mirror.normals_world)
    n = glm::normalize(glm::dvec3(std::tan(-std::acos(0.0) / 4), 0, 1));
  EXPECT_EQ(check(mirror).past, 0u);
}

TEST(SphericalHardCases, PowersOfTheAmplitudeUnderflow) {
  for (const double exponent : {1e3, 1e5, 1e6}) {
    Scene scene = stage({{{0.0, 1.6, 1}, {0.3, 1.7, 1}, {0.1, 1.8, 1}}});
    scene.materials[0].exponent = exponent;
    scene.directional.push_back({{0, 0, 1}, glm::dvec3(1.0)});
    const Accuracy a = check(scene);
    EXPECT_EQ(a.past, 0u) << a;
    // Diffuse light alone: N.H is about a half.
    EXPECT_GT(a.brightest, 40);
  }
}

// L = -V in the middle of the frame, on a surface that is seen from behind its normals.
TEST(SphericalHardCases, HalfwayVectorOfZeroOverZero) {
  for (const double aside : {0.0, 1e-16, 1e-12, 1e-6})
    for (const Brdf brdf : {Brdf::blinn, Brdf::phong}) {
      Scene scene = stage({{{0.2, 0, -1}, {-0.2, 0.1, -1}, {0, -0.2, -1}}});
      scene.materials[0].brdf = brdf;
      const glm::dvec3 v = direction(surface_at(scene, c_frame, 80, 60), scene.camera.eye_world);
      scene.directional.push_back(
          {aside == 0.0 ? -v : glm::normalize(glm::dvec3(aside, 0, 0) - v), glm::dvec3(1.0)});
      const Accuracy a = check(scene);
      EXPECT_EQ(a.past, 0u) << aside << ": " << a;
      EXPECT_GT(a.brightest, 100);
    }
}

TEST(SphericalHardCases, LightAtASurfacePoint) {
  const Scene dark = stage({{{0.6, 0, 1}, {-0.6, 0, 1}, {0, 0.1, 1}}});
  const Drawn drawn = draw(dark, c_frame, spherical_key(dark));
  std::map<int, std::pair<int, int>> line;  // first and last pixel
  for (const Fragment& f : drawn.fragments) {
    auto& [first, last] = line.try_emplace(f.y, f.x, f.x).first->second;
    first = std::min(first, int{f.x});
    last = std::max(last, int{f.x});
  }
  const auto [first, last] = line.at(60);
  ASSERT_LT(first, 60);
  ASSERT_GT(last, 100);
  // At the span's begin, next to it, in the middle, at its end.
  for (const int x : {first, first + 1, 80, last})
    for (const Brdf brdf : {Brdf::blinn, Brdf::phong})
      for (const bool spot : {false, true}) {
        Scene scene = dark;
        scene.materials[0].brdf = brdf;
        const glm::dvec3 there = surface_at(scene, c_frame, x, 60);
        if (spot)
          scene.spots.push_back({there, {1, 0, 0}, 0.9, 0.8, glm::dvec3(1.0)});
        else
          scene.positional.push_back({there, glm::dvec3(1.0)});
        const Accuracy a = check(scene);
        EXPECT_EQ(a.past, 0u) << "pixel " << x << (spot ? ", spot: " : ": ") << a;
      }
}

TEST(SphericalHardCases, EyeAtTheSurface) {
  // The eye's direction is the normal's where eye and point are one.
  Scene scene = stage();
  add_side_lights(scene);
  const SphericalSetup setup(scene, c_frame, spherical_key(scene), {});
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.2, 0.1, 1.0));
  const PointVectors at = setup.vectors_at(scene.materials[0], {scene.camera.eye_world, normal, 0.0});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(glm::length(at.light[i].v), 1.0, 1e-15);
    EXPECT_NEAR(glm::length(glm::cross(at.light[i].v, at.light[i].to_light + normal)), 0.0, 1e-15);
  }
  // Nearly there.
  for (const double height : {1e-3, 1e-6, 1e-9}) {
    scene.camera.eye_world = {0.01, 0.02, height};
    scene.camera.target_world = {0.01, 0.02, 0.0};
    scene.camera.near = 0.5 * height;
    scene.camera.far = 10.0;
    const Accuracy a = check(scene);
    EXPECT_EQ(a.past, 0u) << height << ": " << a;
  }
}

TEST(SphericalHardCases, OnePixelSpans) {
  RandomScenes random(3);
  Scene scene = stage();
  add_side_lights(scene);
  scene.positions_world.clear();
  scene.normals_world.clear();
  scene.triangles.clear();
  for (std::uint32_t i = 0; i < 60; ++i) {  // slivers, from top to bottom
    const double x = -1.5 + 0.05 * i, width = 0.002 + 0.0006 * i;
    for (const glm::dvec3 p :
         {glm::dvec3(x, -1.4, 0), glm::dvec3(x + width, -1.3, 0), glm::dvec3(x, 1.4, 0)}) {
      scene.positions_world.push_back(p);
      scene.normals_world.push_back(glm::normalize(glm::dvec3(0, 0, 1) + 0.7 * random.cube()));
    }
    scene.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, {3 * i, 3 * i + 1, 3 * i + 2}, 0});
  }
  const Accuracy a = check(scene);
  EXPECT_EQ(a.past, 0u) << a;
  EXPECT_GT(2 * a.fragments, a.counts.records) << "most lines cover a pixel";
  EXPECT_LT(a.fragments, 2 * a.counts.records) << "and not many more";
}

// N.L < 0 < N.H: what exact hides and published shows, on a surface that reflects diffusely and on one that
// does not.
TEST(SphericalHardCases, HighlightBehindTheLightsHorizon) {
  for (const double diffuse : {0.5, 0.0}) {
    Scene scene = stage({{{-0.5, 0, 1}, {-0.5, 0.05, 1}, {-0.5, -0.05, 1}}});
    scene.materials[0].diffuse = diffuse;
    scene.materials[0].exponent = 4.0;
    scene.directional.push_back({glm::normalize(glm::dvec3(1, 0, 0.3)), glm::dvec3(1.0)});
    const Accuracy a = check(scene);
    EXPECT_EQ(a.past, 0u) << a;
    EXPECT_EQ(a.brightest, 0);
    int brightest = 0;
    for (const Fragment& f : draw(scene, c_frame, spherical_key(scene, Preset::published)).fragments)
      brightest = std::max(brightest, int{f.red});
    EXPECT_GT(brightest, 10) << "published has no horizon";

    // The horizon across the triangle: a highlight that ends at once, at the right pixel.
    Scene half = stage({{{-0.6, 0, 1}, {0.8, 0.1, 1}, {0, -0.1, 1}}});
    half.materials[0].diffuse = diffuse;
    half.materials[0].exponent = 1.0;
    half.directional.push_back({glm::normalize(glm::dvec3(1, 0, 0.1)), glm::dvec3(1.0)});
    half.positional.push_back({{1.5, 0.0, 0.2}, glm::dvec3(0.5)});
    const Accuracy across = check(half);
    EXPECT_EQ(across.past, 0u) << across;
    EXPECT_GT(across.brightest, 100);
  }
}

TEST(SphericalHardCases, ExponentsFromTheLeastToPastTheLargest) {
  for (const double exponent : {1.0, 1.5, 2.0, 1e6, 1e9, 1e300})
    for (const Brdf brdf : {Brdf::blinn, Brdf::phong}) {
      Scene scene = stage({{{0.3, 0.1, 1}, {-0.3, 0.2, 1}, {0, -0.3, 1}}});
      scene.materials[0].exponent = exponent;
      scene.materials[0].brdf = brdf;
      scene.directional.push_back({glm::normalize(glm::dvec3(0.05, 0.02, 1.0)), glm::dvec3(0.9)});
      const Accuracy a = check(scene);
      EXPECT_EQ(a.past, 0u) << exponent << ": " << a;
    }
  // 1e9 is drawn as 1e6, and a note says so. So far away that even this highlight is wider than a line.
  Scene steep = stage({{{0.003, 0.001, 1}, {-0.003, 0.002, 1}, {0, -0.003, 1}}});
  steep.camera.eye_world.z = 1e9;
  steep.camera.vertical_fov_degrees = 1e-7;
  steep.directional.push_back({{0, 0, 1}, glm::dvec3(0.9)});
  Scene held = steep;
  steep.materials[0].exponent = 1e9;
  held.materials[0].exponent = c_largest_exponent;
  for (const Preset preset : {Preset::exact, Preset::published}) {
    const SphericalSetupOptions whole{.threshold = 1e9};
    EXPECT_EQ(draw(steep, c_frame, spherical_key(steep, preset), whole).words,
              draw(held, c_frame, spherical_key(held, preset), whole).words);
  }
  EXPECT_NE(notes(steep).find("exponent 1e+09 was held at 1e+06"), std::string::npos) << notes(steep);
  EXPECT_EQ(notes(held).find("exponent"), std::string::npos);
}

// 4096 pixels: the angle's drift comes near what the format allows, and stays within it.
TEST(SphericalHardCases, LongSpans) {
  const FrameSize frame{4096, 24};
  double worst = 0.0;
  for (int i = 0; i < 40; ++i) {
    RandomScenes random(static_cast<unsigned>(100 + i));
    Scene scene = stage();
    // All over the frame and, within the guard band, as far as it goes: not clipped.
    scene.positions_world = {{-2.944, 0.0815, 0}, {0, -4.355, 0}, {2.947, 0.0815, 0}};
    scene.camera.vertical_fov_degrees = 0.25;
    for (glm::dvec3& n : scene.normals_world) n = glm::normalize(glm::dvec3(0, 0, 1) + 0.5 * random.cube());
    scene.directional.push_back(
        {glm::normalize(glm::dvec3(0.2, 0.1, 1) + 0.3 * random.cube()), glm::dvec3(1.0)});
    const HardwareKey key = spherical_key(scene);
    const Drawn drawn = draw(scene, frame, key, {.threshold = 1e9});
    expect_words_in_range<Exact>(drawn, key);
    const auto model = make_golden_model(key);
    const golden::SphericalLayout<Exact> layout(golden_config(key));
    const ScreenTriangle triangle = projected(scene, frame).at(0);
    golden::TriangleWalker<Exact> walker;
    walker.line_load(drawn.words);
    for (std::size_t line = 1;; ++line) {
      const std::int64_t way = walker.backward() ? -1 : 1, first = walker.start().value(),
                         last = walker.stop().value() - way, steps = std::abs(last - first);
      if (!walker.line_empty() && steps == 4095) {
        const auto record = std::span(drawn.words).subspan(line * drawn.vector_words, drawn.vector_words);
        using At = Exact::diffuse_header_at;
        using Angle = golden::Word<Exact::c_angle_bits>;
        const int low = layout.diffuse_low(0);
        const std::int64_t word = Angle::from_bits(golden::get_bits(record, At::angle, low)).value() +
                                  steps * Angle::from_bits(golden::get_bits(record, At::slope, low)).value();
        const SurfacePoint end = pixel_point(triangle, last, walker.y());
        // The arc's angle at its end, before any rounding.
        const SurfacePoint begin = pixel_point(triangle, first, walker.y());
        const CosineArc arc =
            cosine_arc(begin.normal_world, end.normal_world, scene.directional[0].to_light_world);
        const double angle = (arc.sweep - arc.phase) / (0.5 * M_PI);
        worst = std::max(worst, std::abs(std::ldexp(double(word), -Exact::c_angle_fraction_bits) - angle));
      }
      if (walker.line_last()) break;
      walker.line_step();
    }
    if (i % 8 == 0) {
      const Accuracy a = check(scene, frame);
      EXPECT_EQ(a.past, 0u) << a;
    }
  }
  std::cout << "largest drift " << worst * 0x1p11 << " of 2^-11 half bells\n";
  EXPECT_LE(worst, 4096 * 0x1p-23);
  EXPECT_GT(worst, 0.9 * 4096 * 0x1p-23);
}

// A highlight of a fraction of a pixel shows where a pixel's centre meets it.
TEST(SphericalHardCases, BellNarrowerThanAPixel) {
  for (const double exponent : {1e4, 1e5, 1e6}) {
    std::uint64_t fragments = 0, past = 0;
    int seen = 0;
    for (int i = 0; i < 40; ++i) {
      RandomScenes random(static_cast<unsigned>(200 + i));
      Scene scene = stage({{{1, 0.6, 1}, {-1, 0.7, 1}, {0, -1, 1}}});
      scene.materials[0].exponent = exponent;
      const SurfacePoint p =
          pixel_point(projected(scene, {40, 30}).at(0), random.whole(17, 23), random.whole(13, 17));
      const glm::dvec3 v = glm::normalize(scene.camera.eye_world - p.position_world);
      // Its peak at one pixel's centre.
      scene.directional.push_back({2.0 * glm::dot(p.normal_world, v) * p.normal_world - v, glm::dvec3(1.0)});
      const Accuracy a = check(scene, {40, 30});
      fragments += a.fragments;
      past += a.past;
      seen += a.brightest > 200;
    }
    std::cout << "exponent " << exponent << ": " << past << " of " << fragments
              << " past the promise, seen in " << seen << " of 40\n";
    EXPECT_EQ(seen, 40);
    EXPECT_LE(past, 0u);
  }
}

TEST(SphericalHardCases, OverExposureIsHeldAndCounted) {
  Scene scene = stage({{{0.1, 0, 1}, {-0.1, 0, 1}, {0, 0.1, 1}}});
  add_side_lights(scene);
  EXPECT_EQ(draw(scene, c_frame, spherical_key(scene)).counts.overexposed, 0u);
  for (const double intensity : {10.0, 1e9, 1e306, 1.7e308}) {
    scene.directional[0].intensity = {intensity, 0.0, 0.0};
    scene.materials[0].colour = {0.9, 0.0, 0.9};  // inf * 0 is no number
    for (const Preset preset : {Preset::exact, Preset::published}) {
      const HardwareKey key = spherical_key(scene, preset);
      const Drawn drawn = draw(scene, c_frame, key);
      if (preset == Preset::exact) expect_words_in_range<Exact>(drawn, key);
      if (preset == Preset::exact && intensity == 10.0)
        EXPECT_EQ(drawn.counts.overexposed, 0u) << "there is room for this";
      else
        EXPECT_GT(drawn.counts.overexposed, 100u);
      ASSERT_GT(drawn.fragments.size(), 1000u);
      for (const Fragment& f : drawn.fragments) {
        ASSERT_EQ(f.red, 255);
        ASSERT_LT(f.green, 255);
      }
    }
  }
  scene.ambient = glm::dvec3(1e300);
  scene.materials[0].ambient = 1.0;
  EXPECT_GT(draw(scene, c_frame, spherical_key(scene)).counts.overexposed, 100u);
}

TEST(SphericalHardCases, NotesSayWhereThePictureIsWorse) {
  Scene scene = stage();
  scene.directional.push_back({{0, 0, 1}, glm::dvec3(1.0)});
  for (const double exponent : {1.0, 2.0, 20.0}) {
    scene.materials[0].exponent = exponent;
    EXPECT_EQ(notes(scene), "");
  }
  scene.materials[0].exponent = 1.3;
  EXPECT_NE(notes(scene).find("that of 1.3 is off by up to 8.6 colour steps"), std::string::npos)
      << notes(scene);
  EXPECT_EQ(notes(scene, Preset::published).find("fits"), std::string::npos);
  // Not worn, or without a highlight.
  scene.materials.push_back({.name = "not worn", .exponent = 1.3});
  scene.materials[0].specular = 0.0;
  EXPECT_EQ(notes(scene), "");

  scene.directional[0].intensity = glm::dvec3(10.0);
  EXPECT_NE(notes(scene).find("a light is reflected 5 times as bright as white"), std::string::npos)
      << notes(scene);
  EXPECT_EQ(notes(scene).find("held"), std::string::npos) << "there is room for this";
  EXPECT_NE(notes(scene, Preset::published).find("over-exposed more than 4 times and were held there: all"),
            std::string::npos)
      << notes(scene, Preset::published);
  scene.directional[0].intensity = glm::dvec3(1e6);
  EXPECT_EQ(notes(scene).find("held"), std::string::npos) << "white all the same";
}

// What is held in preset exact would be white anyway.
TEST(SphericalHardCases, TheLargestFactorTimesTheLeastEntryIsWhite) {
  for (int data_bits = 2; data_bits <= c_white_data_bits; ++data_bits) {
    golden::SaturatingSum sum;
    sum.add(golden::multiply(1, 65535U << Exact::c_factor_fraction_bits));
    EXPECT_EQ(sum.result(Exact::c_factor_fraction_bits + data_bits, Exact::c_colour_bits), 255U) << data_bits;
  }
}

TEST(SphericalHardCases, TrianglesWiderThanTheFrame) {
  for (const double size : {3.0, 100.0, 1e6}) {
    Scene scene = stage({{{0.4, 0, 1}, {-0.5, 0.2, 1}, {0, 0.6, 1}}});
    for (glm::dvec3& p : scene.positions_world) p *= size;
    scene.camera.near = 0.1;
    scene.camera.far = 1e7;
    add_side_lights(scene);
    const Accuracy a = check(scene, {64, 48});
    EXPECT_EQ(a.past, 0u) << size << ": " << a;
    EXPECT_GT(a.fragments, 3000u);
  }
}

TEST(SphericalHardCases, SpotsThatEndAtOnce) {
  for (const double cosine : {0.999, 0.98, 0.9}) {
    Scene scene = stage({{{0.1, 0, 1}, {-0.1, 0, 1}, {0, 0.1, 1}}});
    scene.spots.push_back(
        {{0.3, 0.1, 2.0}, glm::normalize(glm::dvec3(-0.3, -0.2, -2.0)), cosine, cosine, glm::dvec3(1.0)});
    const Accuracy a = check(scene);
    EXPECT_EQ(a.past, 0u) << cosine << ": " << a;
    EXPECT_GT(a.brightest, 100);
  }
}

TEST(SphericalHardCases, SixteenLights) {
  RandomScenes random(4);
  for (int i = 0; i < 4; ++i) {
    Scene scene;
    scene.materials = {random.material(false, false)};
    random.add_triangles(scene, 6, 1.2, 0.6);
    random.add_lights(scene, 16, RandomScenes::any, 1.2, false);
    const auto dim = [](auto& lights) {
      for (auto& light : lights) light.intensity *= 0.15;
    };
    dim(scene.directional);
    dim(scene.positional);
    dim(scene.spots);
    ASSERT_EQ(spherical_key(scene).spherical.lights, 16U);
    const Accuracy a = check(scene);
    EXPECT_EQ(a.past, 0u) << a;
    EXPECT_GT(a.brightest, 30);
  }
}

// Past its bell's ends the published highlight begins again: the register wraps.
TEST(SphericalHardCases, PublishedHighlightsHaveGhosts) {
  Scene scene = stage({{{1.2, 0, 1}, {-1.2, 0, 1}, {0, 0, 1}}});
  scene.materials[0].diffuse = 0.0;
  scene.materials[0].exponent = 200.0;
  scene.directional.push_back({{0, 0, 1}, glm::dvec3(1.0)});
  const auto peaks = [&](Preset preset) {
    std::map<int, int> line;
    for (const Fragment& f : draw(scene, c_frame, spherical_key(scene, preset)).fragments)
      if (f.y == 90) line[f.x] = f.red;
    int count = 0, before = 0;
    for (const auto& [x, red] : line) {
      count += before <= 40 && red > 40;
      before = red;
    }
    return count;
  };
  EXPECT_EQ(peaks(Preset::exact), 1);
  EXPECT_GT(peaks(Preset::published), 2);
  EXPECT_EQ(check(scene).past, 0u);
}

}  // namespace
}  // namespace halfway

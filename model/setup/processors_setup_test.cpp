// SPDX-License-Identifier: Apache-2.0
// Tests the setup of the shading processors through their golden model: frames compared with the reference,
// triangle order compared with line order, scenes that exceed the formats, and lights at the limits of
// direction.
#include "setup/processors_setup.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "frame/metrics.hpp"
#include "golden_run/test/drawing.hpp"
#include "plan/plan.hpp"
#include "reference/renderer.hpp"
#include "scene/builtin_meshes.hpp"
#include "scene/test/random_scenes.hpp"
#include "shading/test/random_solids.hpp"
#include "sim/os/must.hpp"
#include "words/processors_layout.hpp"
#include "words/word.hpp"

namespace halfway {
namespace {

using ::testing::Contains, ::testing::HasSubstr, ::testing::IsEmpty, ::testing::UnorderedElementsAre;

constexpr FrameSize c_small_frame{96, 72};

HardwareKey key_of(const Scene& scene, Preset preset = Preset::exact) {
  return must(plan_scene(scene, {.shader = Shader::processors, .preset = preset})).key;
}

ReferenceImage reference_of(const Scene& scene, FrameSize size) {
  return render_reference(scene, Projector(scene, size, {}).project_all(), {.frame = size});
}

Drawn draw_processors(const Scene& scene, const HardwareKey& key) {
  return draw(scene, c_small_frame, key);
}

FrameDistance distance_of_exact(const Scene& scene) {
  const ReferenceImage reference = reference_of(scene, c_small_frame);
  const Drawn drawn = draw_processors(scene, key_of(scene));
  return *frame_distance(frame_of(scene, c_small_frame, drawn.fragments), reference.frame, reference.mask);
}

// Lights of the given kind over triangles or a mesh.
Scene meshes_or_triangles(RandomScenes& random, RandomScenes::Lights kind) {
  Scene scene;
  scene.name = "random";
  scene.ambient = random.colour(false);
  scene.materials = {random.material(false, false)};
  scene.materials[0].brdf = Brdf::blinn;
  if (random.one_in(2)) {
    add_mesh(scene, make_uv_sphere(9, 7, 1.0));
    scene.camera.eye_world = {0.0, 0.3, 3.4};
  } else {
    random.add_triangles(scene, 12, 0.8, 0.6);
  }
  random.add_lights(scene, random.whole(1, 3), kind, 1.0, false);
  return scene;
}

TEST(ProcessorsSetup, ExactDrawsTheReference) {
  RandomScenes random(1);
  double least = std::numeric_limits<double>::infinity();
  for (const auto kind : {RandomScenes::directional, RandomScenes::positional, RandomScenes::spots})
    for (int i = 0; i < 40; ++i) {
      SCOPED_TRACE(fmt::format("kind {}, scene {}", static_cast<int>(kind), i));
      const Scene scene = meshes_or_triangles(random, kind);
      const FrameDistance d = distance_of_exact(scene);
      EXPECT_LE(d.max_lsb, 1U);
      least = std::min(least, d.psnr_db);
    }
  EXPECT_GT(least, 50.0);
  fmt::print("least PSNR {:.2f} dB\n", least);
}

Scene ball() {
  Scene scene;
  scene.name = "ball";
  scene.materials = {{.name = "clay", .colour = {0.9, 0.5, 0.4}, .specular = 0.5, .exponent = 30.0}};
  add_mesh(scene, make_uv_sphere(16, 12, 1.0));
  scene.camera.eye_world = {0.0, 0.0, 3.4};
  return scene;
}

TEST(ProcessorsSetup, DrawsEmission) {
  for (const double light : {0.0, 0.2, 3.0})
    for (const glm::dvec3 emission : {glm::dvec3(1.0, 0.25, 0.0), glm::dvec3(0.01, 0.0, 5.0)})
      for (const bool lit : {false, true}) {
        SCOPED_TRACE(fmt::format("I_a {}, emission of red {}, lit {}", light, emission.x, lit));
        Scene scene = ball();
        scene.ambient = glm::dvec3(light);
        if (lit) scene.directional = {{glm::normalize(glm::dvec3(-0.5, 0.6, 1.0)), glm::dvec3(0.5)}};
        scene.materials.push_back(scene.materials[0]);
        scene.materials[1].emission = emission;
        for (std::size_t i = 0; i < scene.triangles.size(); ++i)
          scene.triangles[i].material = static_cast<std::uint32_t>(i / 2 % 2);
        EXPECT_LE(distance_of_exact(scene).max_lsb, 1U);
        // Without lights the published word lengths cost half a step for k_a and half a step for the sum.
        // They hold no ambient light above white.
        if (lit || light > 1.0) continue;
        const ReferenceImage reference = reference_of(scene, c_small_frame);
        const Drawn drawn = draw_processors(scene, key_of(scene, Preset::published));
        EXPECT_LE(
            frame_distance(frame_of(scene, c_small_frame, drawn.fragments), reference.frame, reference.mask)
                ->max_lsb,
            1U);
      }
}

// A spot on the middle of a wall. Its narrow cone fills a large part of the picture. Inner and outer edge in
// degrees.
Scene narrow_spot(double inner, double outer) {
  const double radius = 3.0 * std::tan(glm::radians(outer));
  Scene scene;
  scene.name = "spot";
  scene.materials = {{.name = "wall", .ambient = 0.0, .diffuse = 1.0, .specular = 0.0}};
  for (const glm::dvec2 corner : {glm::dvec2(-2, -2), glm::dvec2(2, -2), glm::dvec2(2, 2), glm::dvec2(-2, 2)})
    scene.positions_world.emplace_back(radius * corner, 0.0);
  scene.normals_world = {{0.0, 0.0, 1.0}};
  scene.triangles = {{{0, 1, 2}, {0, 0, 0}, 0}, {{0, 2, 3}, {0, 0, 0}, 0}};
  scene.camera.eye_world = radius * glm::dvec3(1.0, 0.5, 6.0);
  scene.spots = {{.position_world = {0.9, 1.2, 2.6},
                  .axis_world = glm::normalize(-glm::dvec3(0.9, 1.2, 2.6)),
                  .cos_inner = std::cos(glm::radians(inner)),
                  .cos_outer = std::cos(glm::radians(outer))}};
  return scene;
}

// Limits: angles from which on the light's noise exceeds the value in tb/specification/hard_cases.
TEST(ProcessorsSetup, NarrowSpotsAreNoted) {
  for (const auto& [preset, angle] : {std::pair{Preset::exact, 0.4}, {Preset::published, 40.0}}) {
    const Scene scene = narrow_spot(0.0, angle);
    EXPECT_THAT(make_setup(scene, c_small_frame, key_of(scene, preset), {})->notes(),
                Contains(HasSubstr("spot light 1: its cone of")));
  }
  const Scene scene = narrow_spot(0.0, 0.7);
  EXPECT_THAT(make_setup(scene, c_small_frame, key_of(scene), {})->notes(), IsEmpty());
}

// A flat triangle with zero normals uses its own normal.
TEST(ProcessorsSetup, ZeroNormalsUseTheTrianglesOwn) {
  Scene scene = ball();
  scene.directional = {{glm::normalize(glm::dvec3(0.2, 0.3, 1.0)), glm::dvec3(1.0)}};
  scene.normals_world = {glm::dvec3(0.0)};
  for (SceneTriangle& t : scene.triangles) t.normal = {0, 0, 0};
  EXPECT_FALSE(key_of(scene).processors.normalize);
  const FrameDistance d = distance_of_exact(scene);
  EXPECT_LE(d.max_lsb, 1U);
}

std::vector<std::string> setup_notes(const Scene& scene, Preset preset) {
  return make_setup(scene, c_small_frame, key_of(scene, preset), {})->notes();
}

TEST(ProcessorsSetup, ClampedValuesAreNoted) {
  Scene scene = ball();
  scene.directional = {{.intensity = glm::dvec3(64.0)}};
  scene.ambient = glm::dvec3(64.0);
  scene.materials[0].ambient = scene.materials[0].diffuse = 1.0;
  scene.materials[0].exponent = 8000.0;
  scene.materials.push_back({.name = "unworn", .diffuse = 1e6});
  EXPECT_THAT(setup_notes(scene, Preset::exact), IsEmpty());
  // Colour steps, k and exponents as published.
  EXPECT_THAT(setup_notes(scene, Preset::published),
              UnorderedElementsAre(HasSubstr("ambient light is 64 times white and was clamped to 1"),
                                   HasSubstr("directional light 1 is 64 times white and was clamped to 1"),
                                   HasSubstr("'clay': its exponent 8000 was clamped to 1023"),
                                   HasSubstr("its k_a times the ambient light is 57.6 times white"),
                                   HasSubstr("its k_d times the directional light 1 is 57.6 times white"),
                                   HasSubstr("its k_s times the directional light 1 is 32 times white")));
  scene = ball();
  scene.materials[0].diffuse = 20.0;
  scene.positional = {{{0.0, 0.0, 1e30}, glm::dvec3(100.0)}};
  scene.materials[0].exponent = 1e5;
  EXPECT_THAT(
      setup_notes(scene, Preset::exact),
      UnorderedElementsAre(HasSubstr("positional light 1 is 100 times white and was clamped to 64.25"),
                           HasSubstr("'clay': its k_d of 18 was clamped to 16"),
                           HasSubstr("its exponent 100000 was clamped to 8192"),
                           HasSubstr("its k_d times the positional light 1 is 1800 times white"),
                           HasSubstr("so far away that it was drawn as a directional light")));
  // The resulting colours are the largest.
  for (const Preset preset : {Preset::exact, Preset::published})
    for (const Fragment& f : draw_processors(scene, key_of(scene, preset)).fragments)
      if (f.x == c_small_frame.width / 2 && f.y == c_small_frame.height / 2) {
        EXPECT_EQ(f.red, 255);
      }
}

using Request = words::Exact::request_header_at;
using Walked = words::Exact::init_header_at;

// The vectors of a stream, one after the other.
template <class Vector>
void for_each_vector(const std::vector<std::uint32_t>& words, unsigned bits, Vector&& vector) {
  const std::size_t size = (bits + 31) / 32;
  for (std::size_t i = 0; i < words.size(); i += size) vector(std::span(words).subspan(i, size));
}

// A strip: the vector that opens it, triangles and shadow polygons in the order of their first lines, the
// vector that ends it.
TEST(ProcessorsSetup, AStripHasTrianglesAndShadowPolygonsByFirstLine) {
  using words::Command;
  std::uint64_t opening = 0, closing = 0, before_near = 0;
  RandomSolids random(11);
  for (int i = 0; i < 3; ++i) {
    Scene scene = random.on_a_floor(4);
    scene.camera.near = 2.0;  // cuts the shadow volumes
    const auto setup = make_setup(scene, c_small_frame, key_of(scene), {});
    const int walk = words::ProcessorsLayout<words::Exact>::walk_low();
    for (std::uint32_t strip = 0; strip < setup->units(); ++strip) {
      std::vector<std::uint32_t> words;
      SetupCounts counts;
      setup->append(strip, words, counts);
      std::vector<Command> commands;
      std::uint64_t first_line = 0, lines = 0;
      for_each_vector(words, setup->init_bits(), [&](std::span<const std::uint32_t> v) {
        const Command command = words::command_of<words::Exact>(v);
        commands.push_back(command);
        if (commands.size() == 1) lines = words::get_bits(v, Walked::upper_lines, walk);
        if (command == Command::new_scanline) return;
        EXPECT_GE(words::get_bits(v, Walked::y, walk), first_line);
        first_line = words::get_bits(v, Walked::y, walk);
        EXPECT_LT(first_line, lines);
        if (command != Command::shadow) {
          EXPECT_EQ(command, Command::new_object);
          return;
        }
        ++(words::get_bits(v, Request::opens) != 0 ? opening : closing);
        const std::uint64_t light = words::get_bits(v, Request::light);
        EXPECT_TRUE(light >= 1 && light <= 3) << light;
        before_near +=
            words::get_bits(v, Walked::z, walk) == 0 && words::get_bits(v, Walked::z_dx, walk) == 0;
      });
      EXPECT_EQ(commands.front(), Command::new_scanline);
      EXPECT_EQ(commands.back(), Command::new_scanline);
      EXPECT_EQ(std::count(commands.begin(), commands.end(), Command::new_scanline), 2);
      EXPECT_GT(std::count(commands.begin(), commands.end(), Command::new_object), 0);
    }
  }
  EXPECT_GT(opening, 100U);
  EXPECT_GT(closing, 100U);
  EXPECT_GT(before_near, 10U);
}

// A triangle with one normal uses it as N, each component rounded once.
TEST(ProcessorsSetup, AConstantNormalIsRoundedOnce) {
  Scene scene = ball();
  scene.directional = {{.to_light_world = {0.0, 0.0, 1.0}}};
  for (SceneTriangle& t : scene.triangles) t.normal = {t.normal[0], t.normal[0], t.normal[0]};
  const HardwareKey key = key_of(scene);
  const words::ProcessorsLayout<words::Exact> layout(processors_config(key));
  using Plane = words::Exact::plane_header_at;
  constexpr int c_drop = words::Exact::c_plane_sum_fraction_bits - words::Exact::c_vector_fraction_bits;
  int seen = 0;
  for_each_vector(draw_processors(scene, key).words, static_cast<unsigned>(layout.init_bits()), [&](auto v) {
    if (words::get_bits(v, Request::command) != static_cast<std::uint32_t>(words::Command::new_object))
      return;
    EXPECT_EQ(words::get_bits(v, Request::normalize), 0U);
    const auto triangle = words::get_bits(v, Walked::triangle, layout.walk_low());
    // The camera's axes are the world's axes.
    const glm::dvec3 n = scene.normals_world[scene.triangles[triangle].normal[0]];
    for (int axis = 0; axis < 3; ++axis) {
      const auto word = words::Word<words::Exact::c_plane_sum_bits>::from_bits(
          words::get_bits(v, Plane::value, layout.plane_low(axis)));
      EXPECT_EQ(word.value() >> c_drop,
                std::floor(std::ldexp(n[axis], words::Exact::c_vector_fraction_bits) + 0.5));
      EXPECT_EQ(words::get_bits(v, Plane::dx, layout.plane_low(axis)), 0U);
      ++seen;
    }
  });
  EXPECT_GT(seen, 100);
}

// The positions use all bits of their format: the largest coordinate, here a light's, is in [1/2, 1].
TEST(ProcessorsSetup, PlacesFillTheirFormat) {
  for (const Preset preset : {Preset::exact, Preset::published})
    for (const double distance : {30.0, 500.0}) {
      Scene scene = ball();
      scene.positional = {{{0.0, 0.0, -distance}, glm::dvec3(1.0)}};
      const HardwareKey key = key_of(scene, preset);
      const auto setup = make_setup(scene, c_small_frame, key, {});
      std::int64_t place = 0;
      for_each_vector(draw_processors(scene, key).words, setup->init_bits(), [&](auto v) {
        if (words::get_bits(v, Request::light) != 1) return;
        const auto z = [&]<class P>(P) {
          return static_cast<std::int64_t>(words::get_bits(v, P::light_axes_channel_at::place,
                                                           words::ProcessorsLayout<P>::light_axis_low(2))
                                           << (64 - P::c_light_place_bits)) >>
                 (62 - 15);
        };
        place = preset == Preset::exact ? z(words::Exact{}) : z(words::Published{});
      });
      // In 2^-15 of the format's 1.
      EXPECT_LE(place, -(1 << 14)) << to_string(preset) << ' ' << distance;
      EXPECT_GE(place, -(1 << 15));
    }
}

// The published model in double: N is linear on the screen, and is normalized only if a light has a place.
// The eye is at infinity. The vector of a positional highlight is the sum of a unit vector and one of the
// length of the distance to the light.
glm::dvec3 published_radiance(const Scene& scene, const ScreenTriangle& t, glm::dvec3 weight) {
  const Material& m = scene.materials[t.material];
  glm::dvec3 n(0.0), p(0.0);
  for (int i = 0; i < 3; ++i) {
    n += weight[i] * glm::normalize(t.vertex[static_cast<std::size_t>(i)].normal_world);
    p += weight[i] * t.vertex[static_cast<std::size_t>(i)].position_world;
  }
  const glm::dvec3 to_eye = glm::normalize(scene.camera.eye_world - scene.camera.target_world);
  if (!scene.positional.empty()) n = glm::normalize(n);
  glm::dvec3 sum = scene.ambient * m.ambient * m.colour;
  const auto add = [&](glm::dvec3 light, glm::dvec3 half, glm::dvec3 intensity) {
    sum += intensity * (std::max(0.0, glm::dot(n, light)) * m.diffuse * m.colour +
                        std::pow(std::clamp(glm::dot(n, half), 0.0, 1.0), std::round(m.exponent)) *
                            m.specular * m.specular_colour);
  };
  for (const DirectionalLight& l : scene.directional)
    add(l.to_light_world, glm::normalize(l.to_light_world + to_eye), l.intensity);
  for (const PositionalLight& l : scene.positional)
    add(glm::normalize(l.position_world - p), glm::normalize(to_eye + l.position_world - p), l.intensity);
  return 255.0 * glm::min(sum, glm::dvec3(1.0));
}

TEST(ProcessorsSetup, PublishedMatchesThePublishedModel) {
  RandomScenes random(12);
  for (const auto kind : {RandomScenes::directional, RandomScenes::positional}) {
    std::uint64_t fragments = 0, far = 0;
    double sum = 0.0;
    for (int i = 0; i < 20; ++i) {
      Scene scene = meshes_or_triangles(random, kind);
      scene.materials[0].exponent = random.within(2.0, 12.0);
      std::vector<ScreenTriangle> pieces = Projector(scene, c_small_frame, {}).project_all();
      for (const Fragment& f : draw_processors(scene, key_of(scene, Preset::published)).fragments)
        for (const ScreenTriangle& t : pieces) {
          if (t.source != f.triangle) continue;
          const glm::dvec3 weight =
              barycentric_screen(t, (2 * std::int64_t{f.x} + 1) << 4, (2 * std::int64_t{f.y} + 1) << 4);
          if (std::min({weight.x, weight.y, weight.z}) < 0.0) continue;
          const double error = std::abs(published_radiance(scene, t, weight).x - f.red);
          ++fragments;
          sum += error;
          far += error > 8.0;
        }
    }
    fmt::print("{} fragments, {:.2f} steps off on average, {} more than 8\n", fragments,
               sum / static_cast<double>(fragments), far);
    EXPECT_GT(fragments, 10'000U);
    EXPECT_LT(sum, 1.6 * static_cast<double>(fragments));
    EXPECT_LT(far * 1000, fragments);
  }
}

}  // namespace
}  // namespace halfway

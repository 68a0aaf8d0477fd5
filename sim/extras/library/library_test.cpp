// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "projection/project.hpp"
#include "scene/lights.hpp"
#include "setup/quadratic_setup.hpp"
#include "setup/walk_header.hpp"
#include "sim/extras/library/halfway.h"
#include "sim/extras/library/objects.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

constexpr const char* c_scene_folder = HALFWAY_SOURCE_DIR "/sim/scenes";
constexpr const char* c_timing = HALFWAY_SOURCE_DIR "/sim/report/timing.toml";
constexpr FrameSize c_frame{64, 48};

using ScenePointer = std::unique_ptr<halfway_scene, decltype(&halfway_free_scene)>;
using HardwarePointer = std::unique_ptr<halfway_hardware, decltype(&halfway_free_hardware)>;
using VectorsPointer = std::unique_ptr<halfway_vectors, decltype(&halfway_free_vectors)>;
using FragmentsPointer = std::unique_ptr<halfway_fragments, decltype(&halfway_free_fragments)>;

ScenePointer loaded(const char* name) {
  return {halfway_load_scene(name, c_scene_folder, nullptr), halfway_free_scene};
}

HardwarePointer quadratic(int channels, int degree) {
  return {halfway_quadratic(channels, degree, nullptr), halfway_free_hardware};
}

std::vector<std::uint32_t> words_of(const halfway_scene* scene, const halfway_hardware* hardware) {
  const halfway_setup setup = {HALFWAY_TEST_NONE, 0.0};
  const VectorsPointer vectors(
      halfway_scene_vectors(scene, hardware, c_frame.width, c_frame.height, &setup, nullptr),
      halfway_free_vectors);
  return vectors->words;
}

/// The triangles of a scene on the screen, with three colours that depend on the vertex.
std::vector<halfway_screen_triangle> screen_triangles(const Scene& scene) {
  const Projector projector(scene, c_frame, {.subpixel_bits = 4, .clip_to_frame = false});
  std::vector<halfway_screen_triangle> triangles;
  for (const ScreenTriangle& t : projector.project_all()) {
    halfway_screen_triangle triangle{};
    triangle.number = t.source;
    for (std::size_t i = 0; i < 3; ++i) {
      triangle.x[i] = t.vertex[i].x / 16.0;
      triangle.y[i] = t.vertex[i].y / 16.0;
      triangle.z[i] = t.vertex[i].z;
    }
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        triangle.colour[i][c] = static_cast<double>((37 * i + 11 * c + 5 * t.source) % 256);
    triangles.push_back(triangle);
  }
  return triangles;
}

/// The same triangle with vertices 1 and 2 exchanged.
halfway_screen_triangle mirrored(halfway_screen_triangle t) {
  std::swap(t.x[1], t.x[2]);
  std::swap(t.y[1], t.y[2]);
  std::swap(t.z[1], t.z[2]);
  std::swap(t.colour[1], t.colour[2]);
  std::swap(t.colour[3], t.colour[4]);
  return t;
}

TEST(Library, ScreenTrianglesGiveTheVectorsOfTheSetUp) {
  const auto scene = must(load_scene(c_timing, c_scene_folder));
  const std::vector<halfway_screen_triangle> triangles = screen_triangles(scene);
  ASSERT_GE(triangles.size(), 2u);
  for (const int degree : {1, 2}) {
    std::vector<std::uint32_t> expected;
    for (const halfway_screen_triangle& t : triangles) {
      std::array<ScreenPoint, 3> points;
      std::array<std::int64_t, 3> depths{};
      ChannelSamples samples{};
      for (std::size_t i = 0; i < 3; ++i) {
        points[i] = {static_cast<std::int32_t>(16 * t.x[i]), static_cast<std::int32_t>(16 * t.y[i])};
        depths[i] = fixed(depth_steps(t.z[i]), words::Exact::c_depth_sum_fraction_bits);
      }
      for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t c = 0; c < 3; ++c) samples[c][i] = t.colour[i][c];
      append_exact({expected, 3, degree}, {t.number, points, 4, plan_walks(points, 4, c_frame),
                                           DepthFit(points, 4, depths), samples});
    }
    const HardwarePointer hardware = quadratic(3, degree);
    std::vector<halfway_screen_triangle> turned;
    for (const halfway_screen_triangle& t : triangles) turned.push_back(mirrored(t));
    for (const auto& list : {triangles, turned}) {
      halfway_error error;
      const VectorsPointer vectors(halfway_screen_vectors(list.data(), list.size(), hardware.get(),
                                                          c_frame.width, c_frame.height, &error),
                                   halfway_free_vectors);
      ASSERT_TRUE(vectors) << error.text;
      EXPECT_EQ(vectors->words, expected) << "degree " << degree;
    }
  }
}

TEST(Library, ArraysInSpaceGiveTheVectorsOfTheMesh) {
  const ScenePointer scene = loaded("spheres");  // closed surfaces, as arrays have no key cull
  ASSERT_TRUE(scene);
  const Scene& from = scene->scene;
  // One vertex per corner: equal positions are joined, normals are as given.
  std::vector<double> positions, normals;
  for (const SceneTriangle& t : from.triangles)
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis) {
        positions.push_back(from.positions_world[t.position[corner]][axis]);
        normals.push_back(2.0 * from.normals_world[t.normal[corner]][axis]);
      }
  const double colour[] = {0.75, 0.5, 0.25};
  const halfway_mesh mesh = {positions.data(), normals.data(),        positions.size() / 3,
                             nullptr,          from.triangles.size(), colour};
  halfway_error error;
  const ScenePointer made(halfway_make_scene(&mesh, &error), halfway_free_scene);
  ASSERT_TRUE(made) << error.text;
  EXPECT_EQ(halfway_triangle_count(made.get()), from.triangles.size());
  // With the camera and the light of the one, and the materials of the other, both are the same scene.
  const Camera& eye = from.camera;
  const halfway_camera camera = {{eye.eye_world.x, eye.eye_world.y, eye.eye_world.z},
                                 {eye.target_world.x, eye.target_world.y, eye.target_world.z},
                                 {eye.up_world.x, eye.up_world.y, eye.up_world.z},
                                 eye.vertical_fov_degrees};
  // Lights of every kind are replaced.
  scene->scene.positional.emplace_back();
  scene->scene.spots.emplace_back();
  const halfway_light light = {{0.0, 0.0, 3.0}, {0.5, 0.75, 1.0}};
  for (const ScenePointer* pointer : {&scene, &made}) {
    ASSERT_EQ(halfway_set_camera(pointer->get(), &camera, &error), HALFWAY_OK) << error.text;
    ASSERT_EQ(halfway_set_lights(pointer->get(), &light, 1, &error), HALFWAY_OK) << error.text;
    EXPECT_EQ(light_count(pointer->get()->scene), 1U);
  }
  scene->scene.ambient = made->scene.ambient;
  scene->scene.materials.assign(from.materials.size(), made->scene.materials[0]);
  EXPECT_EQ(made->scene.materials[0].colour, glm::dvec3(0.75, 0.5, 0.25));
  const HardwarePointer hardware = quadratic(3, 2);
  const auto words = words_of(made.get(), hardware.get());
  EXPECT_GT(words.size(), 1000u);
  EXPECT_EQ(words, words_of(scene.get(), hardware.get()));
  // An orbit is relative to the camera that was set.
  ASSERT_EQ(halfway_orbit_camera(made.get(), 90.0, 0.0, 1.0, &error), HALFWAY_OK);
  EXPECT_NE(words, words_of(made.get(), hardware.get()));
  ASSERT_EQ(halfway_orbit_camera(made.get(), 0.0, 0.0, 1.0, &error), HALFWAY_OK);
  EXPECT_EQ(words, words_of(made.get(), hardware.get()));
}

TEST(Library, RefusesASceneThatNeedsOtherHardware) {
  const ScenePointer scene = loaded("spheres");
  halfway_error error;
  const HardwarePointer grey = quadratic(1, 2);
  const VectorsPointer none(halfway_scene_vectors(scene.get(), grey.get(), 64, 48, nullptr, &error),
                            halfway_free_vectors);
  EXPECT_FALSE(none);
  EXPECT_EQ(error.code, HALFWAY_BAD_INPUT);
  EXPECT_STREQ(
      error.text,
      "spheres: needs quadratic_shader-exact-c3, but the hardware is quadratic_shader-exact-c1; plan "
      "it for this scene");
}

TEST(Library, RefusesFragmentsOutsideTheFrame) {
  halfway_frame* frame = halfway_make_frame(nullptr, 4, 3, nullptr);
  const halfway_fragment fragments[] = {{0, 5, 2, 3, 10, 20, 30, 0}, {0, 5, 3, 0, 1, 2, 3, 0}};
  halfway_error error;
  EXPECT_EQ(halfway_add_fragments(frame, fragments, 1, &error), HALFWAY_OK);
  const std::uint8_t* pixel = halfway_rgb(frame) + 3 * (2 * 4 + 3);
  EXPECT_EQ(pixel[0], 10);
  EXPECT_EQ(pixel[2], 30);
  EXPECT_EQ(halfway_add_fragments(frame, fragments + 1, 1, &error), HALFWAY_DIFFERS) << error.text;
  halfway_clear_frame(frame);
  EXPECT_EQ(halfway_rgb(frame)[3 * (2 * 4 + 3)], 0);
  halfway_free_frame(frame);
}

TEST(Library, AnErrorMayBeNull) {
  EXPECT_EQ(halfway_load_scene("no such scene", c_scene_folder, nullptr), nullptr);
  EXPECT_EQ(halfway_make_scene(nullptr, nullptr), nullptr);
  EXPECT_EQ(halfway_quadratic(2, 2, nullptr), nullptr);
  halfway_free_scene(nullptr);
}

}  // namespace
}  // namespace halfway

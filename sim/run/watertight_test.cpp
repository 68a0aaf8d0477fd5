// SPDX-License-Identifier: Apache-2.0
// Closed convex meshes drawn by the RTL: each covered pixel exactly once, with and without splitting.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <set>

#include "plan/plan.hpp"
#include "scene/builtin_meshes.hpp"
#include "scene/camera.hpp"
#include "sim/run/scene_stream.hpp"
#include "sim/verilator/verilator_simulator.hpp"

namespace halfway {
namespace {

// A UV sphere, scaled and rotated at random. It stays convex and closed, so one layer faces the eye.
Scene random_solid(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::uniform_int_distribution<std::uint32_t> count(3, 14);
  const Mesh mesh = make_uv_sphere(count(random), count(random), 1.0);
  glm::dmat3 map;
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) map[c][r] = (c == r ? 1.0 : 0.0) + 0.4 * (unit(random) - 0.5);
  Scene scene;
  scene.name = "solid";
  for (const glm::dvec3& p : mesh.positions) scene.positions_world.push_back(map * p);
  scene.normals_world = mesh.normals;
  scene.triangles = mesh.triangles;
  for (SceneTriangle& t : scene.triangles) t.material = 0;
  Material material;
  material.exponent = 1.0 + 300.0 * unit(random);
  scene.materials = {material};
  scene.directional.push_back({glm::normalize(glm::dvec3(unit(random), unit(random), 1.0)), glm::dvec3(1.0)});
  // So close that parts of the solid are often outside the frame.
  scene.camera = fit_camera(bounding_sphere(scene), {unit(random) - 0.5, unit(random) - 0.5, 1.0});
  scene.camera.vertical_fov_degrees *= 0.5 + unit(random);
  return scene;
}

bool faces_eye(const Scene& scene, std::uint32_t triangle) {
  const auto& corner = scene.triangles[triangle].position;
  const glm::dvec3 &a = scene.positions_world[corner[0]], &b = scene.positions_world[corner[1]],
                   &c = scene.positions_world[corner[2]];
  return glm::dot(glm::cross(b - a, c - a), scene.camera.eye_world - a) > 0.0;
}

class Watertight : public testing::TestWithParam<Shader> {};

TEST_P(Watertight, TheRtlDrawsEveryPixelOfAClosedSolidOnce) {
  std::mt19937 random(20);
  const SimulatorFolders folders{HALFWAY_SOURCE_DIR,
                                 std::filesystem::path(HALFWAY_SOURCE_DIR) / "build" / "cache"};
  constexpr FrameSize c_frame{160, 120};
  std::uint64_t split = 0, pixels = 0;
  for (int round = 0; round < 40; ++round) {
    const Scene scene = random_solid(random);
    const HardwareKey key = plan_scene(scene, {.shader = GetParam()})->key;
    SetupOptions options;
    // Split almost all triangles, or none.
    options.quadratic.threshold = options.spherical.threshold = round % 2 == 0 ? 0.25 : 1e6;
    const auto setup = make_setup(scene, c_frame, key, options);
    SceneStream stream(*setup, key, 2);
    auto rtl = VerilatorSimulator::open(key, folders);
    ASSERT_TRUE(rtl) << rtl.error().message;
    std::vector<Fragment> drawn;
    for (Batch batch; stream.next(batch);) ASSERT_TRUE(rtl->run(batch.init_words, drawn, 1 << 20));
    ASSERT_TRUE(rtl->finish(drawn, 1 << 20));
    split += stream.counts().subdivided;

    // Expected pixels: exact coverage of the unsplit triangles. On the outline, snapping may turn over
    // triangles that face away from the eye. Their pixels overlap those of their neighbours and may be drawn
    // twice.
    using Pixel = std::pair<std::uint32_t, std::uint32_t>;
    std::multiset<Pixel> covered, seen;
    std::set<Pixel> turned_over;
    for (const ScreenTriangle& t : Projector(scene, c_frame, {}).project_all()) {
      const bool away = !faces_eye(scene, t.source);
      for_each_span(
          {{{t.vertex[0].x, t.vertex[0].y}, {t.vertex[1].x, t.vertex[1].y}, {t.vertex[2].x, t.vertex[2].y}}},
          4, c_frame, [&](std::uint32_t y, std::uint32_t begin, std::uint32_t end) {
            for (std::uint32_t x = begin; x < end; ++x) {
              covered.insert({y, x});
              if (away) turned_over.insert({y, x});
            }
          });
    }
    for (const Fragment& f : drawn) seen.insert({f.y, f.x});
    EXPECT_EQ(seen, covered) << "round " << round;
    for (const Pixel& p : std::set<Pixel>(seen.begin(), seen.end()))
      EXPECT_TRUE(seen.count(p) == 1 || turned_over.contains(p))
          << "round " << round << ": pixel " << p.second << "," << p.first << " is drawn " << seen.count(p)
          << " times";
    pixels += seen.size();
  }
  EXPECT_GT(split, 100U);
  EXPECT_GT(pixels, 100'000U);
}

INSTANTIATE_TEST_SUITE_P(Shaders, Watertight, testing::Values(Shader::quadratic, Shader::spherical),
                         [](const auto& shader) { return std::string(to_string(shader.param)); });

}  // namespace
}  // namespace halfway

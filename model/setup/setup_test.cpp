// SPDX-License-Identifier: Apache-2.0
// A worker that has seen other units gives the same vectors as a new one.
#include "setup/setup.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <memory>

#include "plan/plan.hpp"
#include "scene/builtin_meshes.hpp"
#include "scene/test/add_mesh.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

// A sphere that the frame and the near plane cut. Neighbours have different materials, and one vertex has no
// normal, so that each triangle there uses its own.
Scene cut_sphere() {
  const Mesh mesh = make_uv_sphere(48, 32, 1.0);
  Scene scene;
  scene.ambient = glm::dvec3(0.3);
  scene.directional.push_back({glm::normalize(glm::dvec3(0.4, 0.5, 1.0)), {0.7, 0.6, 0.5}});
  scene.positional.push_back({{1.0, 1.5, 2.0}, {0.3, 0.4, 0.5}});
  Material smooth, shiny;
  smooth.colour = {0.8, 0.3, 0.2};
  shiny.colour = {0.2, 0.4, 0.9};
  shiny.exponent = 60.0;
  scene.materials = {smooth, shiny};
  add_mesh(scene, mesh);
  for (std::size_t i = 0; i < scene.triangles.size(); ++i)
    scene.triangles[i].material = static_cast<std::uint32_t>(i % 2);
  std::size_t front = 0;  // the vertex that is nearest to the eye and right of it
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (glm::dot(mesh.positions[i], glm::dvec3(0.3, 0.1, 1.0)) >
        glm::dot(mesh.positions[front], glm::dvec3(0.3, 0.1, 1.0)))
      front = i;
  for (SceneTriangle& t : scene.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      if (t.position[i] == front) scene.normals_world[t.normal[i]] = glm::dvec3(0.0);
  scene.camera.eye_world = {0.0, 0.0, 1.6};
  scene.camera.near = 0.62;
  scene.camera.far = 3.0;
  return scene;
}

TEST(SetupWorker, GivesTheSameVectorsAfterOtherUnits) {
  const Scene scene = cut_sphere();
  for (const Shader shader : {Shader::quadratic, Shader::spherical, Shader::processors})
    for (const Preset preset : {Preset::exact, Preset::published}) {
      const auto plan = must(plan_scene(scene, {.shader = shader, .preset = preset}));
      const std::unique_ptr<halfway::Setup> setup = make_setup(scene, {160, 90}, plan.key, {});
      std::vector<std::uint32_t> by_one, by_many;
      SetupCounts one, many;
      setup->append_all(by_one, one);
      for (std::uint32_t unit = 0; unit < setup->units(); ++unit) setup->append(unit, by_many, many);
      EXPECT_TRUE(by_one == by_many) << to_string(shader) << ' ' << to_string(preset);
      EXPECT_EQ(one.shaded, many.shaded);
      EXPECT_EQ(one.vectors, many.vectors);
      EXPECT_GT(one.triangles, 100U);
      EXPECT_GT(one.projection.outside + one.projection.behind_near, 0U);
    }
}

}  // namespace
}  // namespace halfway

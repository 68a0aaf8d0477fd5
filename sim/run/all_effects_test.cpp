// SPDX-License-Identifier: Apache-2.0
// Hardware with every effect must draw the same fragments as hardware with only the effects that the scene
// needs. Each subset of effects goes through the golden model. The RTL is compared by the tests
// frame.SHADER.all_effects.PRESET, and its clocks by BenchWorkload.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <set>
#include <string>
#include <vector>

#include "plan/plan.hpp"
#include "scene/builtin_meshes.hpp"
#include "shading/test/random_solids.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

constexpr FrameSize c_effects_frame{40, 30};

/// The lights and effects of a scene.
struct Subset {
  unsigned directional = 0, positional = 0, spots = 0;
  bool ambient = true, diffuse = false, specular = false;
  bool coloured = false, coloured_highlights = false;
  bool curved = true, shadows = false;

  std::string name() const {
    return fmt::format("{} directional, {} positional, {} spots{}{}{}{}{}{}{}", directional, positional,
                       spots, ambient ? ", ambient" : "", diffuse ? ", diffuse" : "",
                       specular ? ", specular" : "", coloured ? ", coloured" : "",
                       coloured_highlights ? ", coloured highlights" : "", curved ? "" : ", flat",
                       shadows ? ", shadows" : "");
  }
};

// All combinations of the shader's effects. The shading processors have two more than the others.
std::vector<Subset> every_subset(Shader shader) {
  const unsigned all = shader == Shader::processors ? 128 : 32;
  std::vector<Subset> subsets;
  for (unsigned lights = 0; lights < 27; ++lights)
    for (unsigned bits = 0; bits < all; ++bits)
      subsets.push_back({lights % 3, lights / 3 % 3, lights / 9, (bits & 1) == 0, (bits & 2) != 0,
                         (bits & 4) != 0, (bits & 8) != 0, (bits & 16) != 0, (bits & 32) == 0,
                         (bits & 64) != 0});
  return subsets;
}

/// A sphere of two materials, lit from the eye's side. Its two exponents use different tables. With shadows,
/// a box in front of the sphere casts one on it.
Scene scene_of(const Subset& subset) {
  Scene scene;
  scene.name = "subset";
  scene.ambient = glm::dvec3(subset.ambient ? 0.5 : 0.0);
  for (unsigned i = 0; i < subset.directional; ++i)
    scene.directional.push_back({glm::normalize(glm::dvec3(i == 0 ? -0.5 : 0.9, 0.6, 1.0)), glm::dvec3(0.4)});
  for (unsigned i = 0; i < subset.positional; ++i)
    scene.positional.push_back({glm::dvec3(i == 0 ? 1.5 : -1.2, i == 0 ? 0.7 : -0.8, 1.6), glm::dvec3(0.35)});
  for (unsigned i = 0; i < subset.spots; ++i) {
    const glm::dvec3 position(i == 0 ? -1.5 : 0.6, i == 0 ? 0.3 : -1.4, 2.0);
    scene.spots.push_back({.position_world = position,
                           .axis_world = glm::normalize(-position),
                           .cos_inner = 0.99,
                           .cos_outer = 0.9,
                           .intensity = glm::dvec3(0.45)});
  }
  for (const double exponent : {5.0, 60.0}) {
    Material m;
    m.name = fmt::format("of exponent {}", exponent);
    m.ambient = 0.2;
    m.colour = subset.coloured ? glm::dvec3(0.9, 0.6, 0.3) : glm::dvec3(0.8);
    m.specular_colour = subset.coloured_highlights ? glm::dvec3(1.0, 0.9, 0.5) : glm::dvec3(1.0);
    m.diffuse = subset.diffuse ? 0.5 : 0.0;
    m.specular = subset.specular ? 0.6 : 0.0;
    m.exponent = exponent;
    scene.materials.push_back(m);
  }
  Mesh mesh = make_uv_sphere(8, 6, 1.0);
  if (!subset.curved) {
    // Use one normal per triangle: that of its first corner.
    for (SceneTriangle& t : mesh.triangles) t.normal = {t.normal[0], t.normal[0], t.normal[0]};
  }
  add_mesh(scene, mesh);
  scene.shadows = subset.shadows;
  if (subset.shadows) {
    Mesh box = make_box(glm::dvec3(0.5), 1);
    for (glm::dvec3& p : box.positions) p += glm::dvec3(-0.1, 0.25, 1.3);
    add_mesh(scene, box);
  }
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) scene.triangles[i].material = i % 2;
  scene.camera = {.eye_world = {0.0, 0.0, 3.4}, .vertical_fov_degrees = 40.0};
  return scene;
}

std::vector<Fragment> drawn(const Scene& scene, const HardwareKey& key) {
  return must(whole_stream(scene, c_effects_frame, key)).golden;
}

struct Hardware {
  Shader shader;
  Preset preset;
};

class EachShader : public ::testing::TestWithParam<Hardware> {
 protected:
  PlanRequest request() const { return {.shader = GetParam().shader, .preset = GetParam().preset}; }
};

// In every eighth, the hardware has more lights than the scene. They stay dark.
TEST_P(EachShader, DrawTheSameForEverySubset) {
  const bool is_quadratic = GetParam().shader == Shader::quadratic;
  std::set<std::string> keys;
  unsigned number = 0;
  for (const Subset& subset : every_subset(GetParam().shader)) {
    SCOPED_TRACE(subset.name());
    const Scene scene = scene_of(subset);
    PlanRequest asked = request();
    if (!is_quadratic && ++number % 8 == 0) asked.lights = 16;
    const Plan plan = must(plan_scene(scene, asked));
    keys.insert(plan.called_for.name());
    const std::vector<Fragment> called_for = drawn(scene, plan.called_for);
    ASSERT_FALSE(called_for.empty());
    ASSERT_TRUE(called_for == drawn(scene, plan.everything));
  }
  // Spherical: 0 to 6 lights. For each number above 0: diffuse, specular by colours, both; one and three
  // channels. Processors: one and three channels. For each of 26 sets of lights: diffuse, specular, both;
  // with and without shadows; in preset exact also with and without normalization of N.
  const std::size_t normals = GetParam().preset == Preset::exact ? 2 : 1;
  EXPECT_EQ(keys.size(), is_quadratic                             ? 2U
                         : GetParam().shader == Shader::spherical ? 2 + 6 * (2 + 2 * (1 + 2))
                                                                  : 2 * (1 + 26 * 3 * 2 * normals));
}

// Each effect must change the frame: otherwise equal frames would prove nothing.
TEST_P(EachShader, EachShowsInTheFrame) {
  const bool is_processors = GetParam().shader == Shader::processors;
  const Subset full{2, 2, 2, true, true, true, true, true, true, is_processors};
  std::vector<Subset> less(is_processors ? 10 : 8, full);
  less[0].directional = less[1].positional = less[2].spots = 1;
  less[3].ambient = less[4].diffuse = less[5].specular = less[6].coloured = less[7].coloured_highlights =
      false;
  if (is_processors) less[8].curved = less[9].shadows = false;
  const auto golden = [&](const Subset& subset) {
    const Scene scene = scene_of(subset);
    PlanRequest asked = request();
    if (is_processors) asked.objects = c_object_processors;
    return drawn(scene, must(plan_scene(scene, asked)).everything);
  };
  const std::vector<Fragment> all = golden(full);
  for (const Subset& subset : less) {
    const std::vector<Fragment> without = golden(subset);
    std::size_t changed = 0;
    for (const Fragment& f : without)
      for (const Fragment& g : all)
        changed += f.x == g.x && f.y == g.y && f.triangle == g.triangle &&
                   (f.red != g.red || f.green != g.green || f.blue != g.blue);
    EXPECT_GT(changed, 20U) << subset.name();
  }
}

INSTANTIATE_TEST_SUITE_P(AllEffects, EachShader,
                         ::testing::Values(Hardware{Shader::quadratic, Preset::exact},
                                           Hardware{Shader::quadratic, Preset::published},
                                           Hardware{Shader::spherical, Preset::exact},
                                           Hardware{Shader::spherical, Preset::published},
                                           Hardware{Shader::processors, Preset::exact},
                                           Hardware{Shader::processors, Preset::published}),
                         [](const auto& test) {
                           return fmt::format("{}_{}", to_string(test.param.shader),
                                              to_string(test.param.preset));
                         });

}  // namespace
}  // namespace halfway

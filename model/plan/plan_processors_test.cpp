// SPDX-License-Identifier: Apache-2.0
// Which shading processors a scene needs, and the reasons given.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "common/test/is_error.hpp"
#include "plan/test/planned.hpp"

namespace halfway {
namespace {

using ::testing::AllOf, ::testing::HasSubstr;

Plan planned_processors(const Scene& scene, PlanRequest request = {}) {
  request.shader = Shader::processors;
  return must(plan_scene(scene, request));
}
std::string key(const Scene& scene, const PlanRequest& request = {}) {
  return planned_processors(scene, request).key.name();
}
std::string refusal(const Scene& scene, PlanRequest request = {}) {
  request.shader = Shader::processors;
  const auto plan = plan_scene(scene, request);
  EXPECT_TRUE(is_error(plan, ExitCode::bad_input));
  return plan ? "" : plan.error().message;
}

// AllEffects/EachShader tests that the hardware has what a scene needs, and no more.
TEST(PlanProcessors, HasTheProcessorsThatTheSceneNeeds) {
  EXPECT_EQ(key(grey_scene()), "processors_shader-exact-c1-l0.0.0-unrolled");
  Scene scene = with_lights(1, 2, 3);
  EXPECT_EQ(key(scene), "processors_shader-exact-c1-l1.2.3-d-s-unrolled");
  scene.positional[0].intensity = glm::dvec3(0.0);
  scene.materials[0].diffuse = 0.0;
  scene.shadows = true;
  EXPECT_EQ(key(scene), "processors_shader-exact-c1-l1.1.3-s-shadows-unrolled-o16x1");
  EXPECT_EQ(key(scene, {.objects = 5}), "processors_shader-exact-c1-l1.1.3-s-shadows-unrolled-o5x1");
  EXPECT_EQ(effect(planned_processors(scene), Effect::shadow).by, DoneBy::hardware);
  scene.materials[0].specular = 0.0;
  EXPECT_EQ(key(scene), "processors_shader-exact-c1-l0.0.0-unrolled");
  EXPECT_EQ(effect(planned_processors(scene), Effect::normalization).why, "no material reflects a light");
}

TEST(PlanProcessors, NormalizesIfNormalsDifferOrAsPublishedForLightsWithAPlace) {
  Scene curved = with_lights(1);
  curved.triangles.push_back({{0, 1, 2}, {0, 1, 2}, 0});
  for (const Preset preset : {Preset::exact, Preset::published}) {
    const bool exact = preset == Preset::exact;
    const auto expect_normalization = [&](const Scene& scene, bool called_for, const char* why) {
      const Plan plan = planned_processors(scene, {.preset = preset});
      const PlannedEffect& e = effect(plan, Effect::normalization);
      for (const bool is : {e.called_for, e.elaborated, plan.key.processors.normalize})
        EXPECT_EQ(is, called_for);
      EXPECT_THAT(e.why, HasSubstr(why));
    };
    expect_normalization(with_lights(1), false, exact ? "each triangle has one normal" : "version I:");
    expect_normalization(with_lights(0, 0, 1), !exact, "");
    expect_normalization(curved, exact, exact ? "triangle 1" : "version I:");
    curved.triangles[1].normal = {0, 2, 1};
    expect_normalization(curved, exact, "");
  }
}

TEST(PlanProcessors, OnlyBlinnHighlightsAreSupported) {
  for (const Brdf brdf : {Brdf::phong, Brdf::cook_torrance}) {
    Scene scene = with_lights(1);
    scene.materials.push_back({.name = "other", .brdf = brdf});
    EXPECT_EQ(key(scene), key(with_lights(1)));  // not in use
    scene.triangles.push_back(scene.triangles[0]);
    scene.triangles.back().material = 1;
    EXPECT_THAT(refusal(scene),
                AllOf(HasSubstr("'other'"), HasSubstr("make it blinn"), HasSubstr("quadratic")));
    scene.materials[1].specular = 0.0;
    EXPECT_EQ(key(scene), key(with_lights(1)));
    scene.materials[1].specular = 0.4;
    scene.directional.clear();
    EXPECT_EQ(key(scene), key(grey_scene()));
  }
}

TEST(PlanProcessors, AllEffectsUsesSpotHardwareForEveryLight) {
  for (const Preset preset : {Preset::exact, Preset::published}) {
    const std::string begin = fmt::format("processors_shader-{}-c3-l0.0.", to_string(preset));
    const auto all = [&](const Scene& scene, std::optional<unsigned> lights = {}) {
      return key(scene, {.preset = preset, .all_effects = true, .lights = lights});
    };
    EXPECT_EQ(all(grey_scene()), begin + "1-d-s-n-unrolled");
    EXPECT_EQ(all(with_lights(2, 1, 1)), begin + "4-d-s-n-unrolled");
    EXPECT_EQ(all(with_lights(2, 1, 1), 16), begin + "16-d-s-n-unrolled");
    Scene shadowed = with_lights(2);
    shadowed.shadows = true;
    EXPECT_EQ(all(shadowed), begin + "2-d-s-n-shadows-unrolled-o16x1");
    EXPECT_EQ(planned_processors(with_lights(1), {.preset = preset}).everything.name(), all(with_lights(1)));
  }
  EXPECT_EQ(refusal(with_lights(3), {.all_effects = true, .lights = 2}), "--lights: 2 is not 3 to 16");
  EXPECT_EQ(refusal(with_lights(3), {.all_effects = true, .lights = 17}), "--lights: 17 is not 3 to 16");
}

TEST(PlanProcessors, TwoForms) {
  EXPECT_EQ(key(with_lights(1), {.form = ProcessorForm::folded}),
            "processors_shader-exact-c1-l1.0.0-d-s-folded");
  EXPECT_THAT(key(with_lights(1), {.all_effects = true, .form = ProcessorForm::folded}),
              ::testing::EndsWith("-folded"));
  for (const Shader shader : {Shader::quadratic, Shader::spherical}) {
    EXPECT_TRUE(
        is_error(plan_scene(with_lights(1), {.shader = shader, .form = ProcessorForm::folded}), "--form"));
  }
  EXPECT_THAT(refusal(grey_scene(), {.tables = words::CosineSize{6, 6}}),
              HasSubstr("only the spherical shader"));
}

TEST(PlanProcessors, OtherKeysDifferInOneEffect) {
  Scene shaded = with_lights(1, 1, 1);
  shaded.shadows = true;
  shaded.triangles[0].normal = {0, 1, 2};
  for (const bool all_effects : {false, true})
    for (const Scene& scene : {grey_scene(), with_lights(1), with_lights(0, 2), shaded}) {
      const Plan plan = planned_processors(scene, {.all_effects = all_effects});
      const ProcessorUnits& here = plan.key.processors;
      SCOPED_TRACE(plan.key.name());
      for (const PlannedEffect& e : plan.effects) {
        EXPECT_NE(e.other.value_or(HardwareKey{}).name(), plan.key.name()) << to_string(e.effect);
      }
      const auto other = [&](Effect of) { return effect(plan, of).other->processors; };
      EXPECT_NE(here.shadows, other(Effect::shadow).shadows);
      EXPECT_EQ(effect(plan, Effect::shadow).elaborated, here.shadows);
      EXPECT_NE(here.diffuse, other(Effect::diffuse).diffuse);
      EXPECT_NE(here.normalize, other(Effect::normalization).normalize);
      EXPECT_NE(here.spots, other(Effect::spot).spots);
      EXPECT_EQ(effect(plan, Effect::spot).elaborated, here.spots > 0);
    }
}

}  // namespace
}  // namespace halfway
